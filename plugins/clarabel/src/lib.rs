//! The plugin over Clarabel: an interior-point method for conic programs with quadratic objectives.
//!
//! ```text
//! abi      the records of switchyard/abi.h
//! edge     the C functions: errors and panics become a status and a sentence
//! options  Clarabel's settings as a table
//! problem  a sy_problem as Clarabel's data
//! solver   an instance: load, update, solve
//! watch    what happens while Clarabel runs: limits, cancellation, progress, log
//! answer   what Clarabel found, in the terms of the header
//! ```

mod abi;
mod answer;
mod edge;
mod options;
mod problem;
mod solver;
mod watch;
