//! Clarabel's settings, letter for letter, and how the budget of one solve is laid over them.

use std::ffi::{CStr, CString};
use std::os::raw::c_char;
use std::ptr::null;

use crate::abi::*;
use crate::edge::{argument, Failure};

pub type Settings = clarabel::solver::DefaultSettings<f64>;

/// Where a setting stands in Clarabel's record, and what it may be.
enum Field {
    Switch(fn(&mut Settings) -> &mut bool),
    Count(fn(&mut Settings) -> &mut u32),
    Real(fn(&mut Settings) -> &mut f64, Range),
    Choice(fn(&mut Settings) -> &mut String, &'static [&'static str]),
}
use Field::{Choice, Count, Real, Switch};

#[derive(Clone, Copy)]
struct Range {
    lower: f64,
    upper: f64,
}

const SIZE: Range = Range { lower: 0.0, upper: f64::INFINITY };
const SHARE: Range = Range { lower: 0.0, upper: 1.0 };

struct Row {
    name: &'static str,
    field: Field,
    help: &'static str,
}

macro_rules! rows {
    ($($(#[$on:meta])* $name:ident: $kind:ident $(($range:expr))?, $help:literal;)*) => {
        &[$($(#[$on])* Row {
            name: stringify!($name),
            field: $kind(|s| &mut s.$name $(, $range)?),
            help: $help,
        },)*]
    };
}

const ROWS: &[Row] = rows! {
    max_iter: Count, "iterations at most";
    time_limit: Real(SIZE), "seconds at most, set-up included";
    verbose: Switch, "print the iterations to the host's log";
    max_step_fraction: Real(SHARE), "of the way to the boundary, in a step";
    tol_gap_abs: Real(SIZE), "absolute duality gap; this or tol_gap_rel must hold";
    tol_gap_rel: Real(SIZE), "relative duality gap";
    tol_feas: Real(SIZE), "relative residual, primal and dual";
    tol_infeas_abs: Real(SIZE), "absolute tolerance of certificates";
    tol_infeas_rel: Real(SIZE), "relative tolerance of certificates";
    tol_ktratio: Real(SIZE), "kappa / tau below which a certificate is looked for";
    reduced_tol_gap_abs: Real(SIZE), "absolute gap of AlmostSolved";
    reduced_tol_gap_rel: Real(SIZE), "relative gap of AlmostSolved";
    reduced_tol_feas: Real(SIZE), "residuals of AlmostSolved";
    reduced_tol_infeas_abs: Real(SIZE), "absolute tolerance of an almost certificate";
    reduced_tol_infeas_rel: Real(SIZE), "relative tolerance of an almost certificate";
    reduced_tol_ktratio: Real(SIZE), "kappa / tau of an almost certificate";
    equilibrate_enable: Switch, "scale rows and columns first";
    equilibrate_max_iter: Count, "rounds of scaling";
    equilibrate_min_scaling: Real(SIZE), "smallest scale factor";
    equilibrate_max_scaling: Real(SIZE), "largest scale factor";
    linesearch_backtrack_step: Real(SHARE), "factor of backtracking";
    min_switch_step_length: Real(SHARE),
        "shorter steps switch to dual scaling (exponential and power cones)";
    min_terminate_step_length: Real(SHARE), "shorter steps end with InsufficientProgress";
    direct_solve_method: Choice(&["auto", "qdldl"]), "factorization of the linear systems";
    static_regularization_enable: Switch, "regularize the linear systems";
    static_regularization_constant: Real(SIZE), "added to the diagonal";
    static_regularization_proportional: Real(SIZE),
        "the same, relative to the largest diagonal entry";
    dynamic_regularization_enable: Switch, "repair small pivots";
    dynamic_regularization_eps: Real(SIZE), "a pivot below this is small";
    dynamic_regularization_delta: Real(SIZE), "what a small pivot becomes";
    iterative_refinement_enable: Switch, "refine the solutions of the linear systems";
    iterative_refinement_reltol: Real(SIZE), "relative residual to reach";
    iterative_refinement_abstol: Real(SIZE), "absolute residual to reach";
    iterative_refinement_max_iter: Count, "refinements at most";
    iterative_refinement_stop_ratio: Real(SIZE), "stop where the residual shrinks by less";
    presolve_enable: Switch, "drop rows without a bound; off where updates are to come";
    input_sparse_dropzeros: Switch, "drop stored zeros; off where updates are to come";
    #[cfg(feature = "psd")]
    chordal_decomposition_enable: Switch,
        "split sparse semidefinite cones; off where updates are to come";
    #[cfg(feature = "psd")]
    chordal_decomposition_merge_method: Choice(&["none", "parent_child", "clique_graph"]),
        "how cliques are merged";
    #[cfg(feature = "psd")]
    chordal_decomposition_compact: Switch, "assemble the split system in compact form";
    #[cfg(feature = "psd")]
    chordal_decomposition_complete_dual: Switch, "complete the duals of split cones";
};

/// Clarabel's own defaults, silent: a plugin prints nothing unless asked.
fn defaults() -> Settings {
    Settings { verbose: false, ..Settings::default() }
}

/// The options an instance was given.
pub struct Options {
    chosen: Settings,
    set: Vec<&'static str>, // the names the caller set: they stand above sy_control
}

impl Options {
    pub fn new() -> Options {
        Options { chosen: defaults(), set: Vec::new() }
    }

    /// # Safety
    /// A text in `value` is a C string.
    pub unsafe fn set(&mut self, name: &str, value: &sy_value) -> Result<(), Failure> {
        let Some(Row { name, field, .. }) = ROWS.iter().find(|row| row.name == name) else {
            return Err(argument(format!("clarabel has no option {name}")));
        };
        let s = &mut self.chosen;
        match *field {
            Switch(at) => *at(s) = integer_of(name, value, 1)? == 1,
            Count(at) => *at(s) = integer_of(name, value, u32::MAX)?,
            Real(at, range) => *at(s) = real_of(name, value, range)?,
            Choice(at, choices) => *at(s) = text_of(name, value, choices)?.to_string(),
        }
        self.set.push(name);
        Ok(())
    }

    /// The settings of a load: what changes the problem's shape is off where numbers are to be
    /// updated in place.
    pub fn settings(&self, updatable: bool) -> Settings {
        let mut s = self.chosen.clone();
        if updatable {
            s.presolve_enable = false;
            s.input_sparse_dropzeros = false;
            #[cfg(feature = "psd")]
            {
                s.chordal_decomposition_enable = false;
            }
        }
        s
    }

    /// The settings of one solve: a solver's own option stands above the common tolerance; of two
    /// limits the smaller one holds.
    pub fn under(&self, control: &sy_control, updatable: bool) -> Settings {
        let mut s = self.settings(updatable);
        let common = |name: &str, value: f64, own: f64| {
            if value.is_nan() || self.set.contains(&name) {
                own
            } else {
                value
            }
        };
        s.tol_feas = common("tol_feas", control.feasibility, s.tol_feas);
        s.tol_gap_abs = common("tol_gap_abs", control.optimality, s.tol_gap_abs);
        s.tol_gap_rel = common("tol_gap_rel", control.optimality, s.tol_gap_rel);
        if control.iterations != i64::MAX {
            let limit = control.iterations.clamp(0, i64::from(u32::MAX)) as u32;
            let own = if self.set.contains(&"max_iter") { s.max_iter } else { u32::MAX };
            s.max_iter = limit.min(own);
        }
        s.verbose |= control.verbosity > 0;
        s
    }
}

fn integer_of(name: &str, value: &sy_value, upper: u32) -> Result<u32, Failure> {
    if value.type_ != SY_INTEGER {
        return Err(argument(format!("clarabel: {name} is an integer in [0, {upper}]")));
    }
    // SAFETY: the type says which member is set.
    let given = unsafe { value.as_.integer };
    match u32::try_from(given) {
        Ok(integer) if integer <= upper => Ok(integer),
        _ => Err(argument(format!("clarabel: {name} = {given} is not in [0, {upper}]"))),
    }
}

fn real_of(name: &str, value: &sy_value, range: Range) -> Result<f64, Failure> {
    let Range { lower, upper } = range;
    // SAFETY: the type says which member is set.
    let given = match value.type_ {
        SY_REAL => unsafe { value.as_.real },
        SY_INTEGER => unsafe { value.as_.integer as f64 },
        _ => return Err(argument(format!("clarabel: {name} is a number in [{lower}, {upper}]"))),
    };
    if !(lower..=upper).contains(&given) {
        return Err(argument(format!("clarabel: {name} = {given} is not in [{lower}, {upper}]")));
    }
    Ok(given)
}

unsafe fn text_of<'a>(
    name: &str,
    value: &sy_value,
    choices: &[&'a str],
) -> Result<&'a str, Failure> {
    let listed = choices.join(", ");
    if value.type_ != SY_TEXT || value.as_.text.is_null() {
        return Err(argument(format!("clarabel: {name} is one of {listed}")));
    }
    let given = CStr::from_ptr(value.as_.text).to_string_lossy();
    match choices.iter().find(|choice| **choice == given) {
        Some(choice) => Ok(choice),
        None => Err(argument(format!("clarabel: {name} = {given} is not one of {listed}"))),
    }
}

/// The table as the host reads it. It lives as long as the process.
pub fn table() -> *const *const sy_option {
    let mut fallback = defaults();
    let options = ROWS.iter().map(|row| record_of(row, &mut fallback) as *const sy_option);
    forever(options.chain([null()]).collect())
}

fn record_of(row: &Row, fallback: &mut Settings) -> &'static sy_option {
    let Row { name, field, help } = row;
    let integer = |v: i64, upper: f64| (SY_INTEGER, sy_value_as { integer: v }, 0.0, upper);
    let (type_, as_, lower, upper) = match *field {
        Switch(at) => integer(i64::from(*at(fallback)), 1.0),
        Count(at) => integer(i64::from(*at(fallback)), f64::from(u32::MAX)),
        Real(at, r) => (SY_REAL, sy_value_as { real: *at(fallback) }, r.lower, r.upper),
        Choice(at, _) => (SY_TEXT, sy_value_as { text: c_text(at(fallback)) }, 0.0, 0.0),
    };
    let choices = match field {
        Choice(_, choices) => forever(choices.iter().map(|c| c_text(c)).chain([null()]).collect()),
        _ => null(),
    };
    Box::leak(Box::new(sy_option {
        size: std::mem::size_of::<sy_option>() as u32,
        reserved: 0,
        name: c_text(name),
        help: c_text(help),
        fallback: sy_value { type_, reserved: 0, as_ },
        lower,
        upper,
        choices,
    }))
}

fn forever<T>(list: Vec<T>) -> *const T {
    Box::leak(list.into_boxed_slice()).as_ptr()
}

/// A C string that lives as long as the process. Its text holds no zero byte.
pub fn c_text(text: &str) -> *const c_char {
    CString::new(text).unwrap_or_default().into_raw()
}
