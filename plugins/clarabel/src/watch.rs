//! What happens while Clarabel runs: once an iteration the host is told and asked, and the deadline
//! is looked at; what Clarabel prints goes to the host's log.

use std::ffi::CString;
use std::io;
use std::time::Instant;

use clarabel::solver::DefaultInfo;

use crate::abi::*;
use crate::options::Settings;

#[derive(Clone, Copy, PartialEq)]
pub enum Stop {
    No,
    Cancelled,
    Deadline,
}

/// The budget of one solve and its watcher.
pub struct Watch {
    control: sy_control,
    started: Instant,
    offset: f64, // of the objective
    tolerances: [f64; 3],
    stop: Stop,
}

impl Watch {
    pub fn new(control: sy_control, started: Instant, offset: f64, settings: &Settings) -> Watch {
        let tolerances = [settings.tol_feas, settings.tol_gap_abs, settings.tol_gap_rel];
        Watch { control, started, offset, tolerances, stop: Stop::No }
    }

    /// Who asked for the end, once Clarabel came back.
    pub fn stop(&self) -> Stop {
        self.stop
    }

    /// Is the solve to end at this iterate?
    fn look(&mut self, info: &DefaultInfo<f64>) -> bool {
        if self.host_wants_an_end(info) {
            self.stop = Stop::Cancelled;
        } else if self.seconds() >= self.control.seconds && !self.solved(info) {
            // Clarabel's own time_limit reads a clock that stands still within an iteration.
            self.stop = Stop::Deadline;
        }
        self.stop != Stop::No
    }

    fn seconds(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    fn host_wants_an_end(&self, info: &DefaultInfo<f64>) -> bool {
        let context = self.control.context;
        // SAFETY: the host's functions, with the context that belongs to them.
        unsafe {
            matches!(self.control.cancelled, Some(ask) if ask(context) != 0)
                || matches!(self.control.progress, Some(tell) if tell(context, &self.at(info)) != 0)
        }
    }

    fn at(&self, info: &DefaultInfo<f64>) -> sy_progress {
        sy_progress {
            size: std::mem::size_of::<sy_progress>() as u32,
            reserved: 0,
            iteration: i64::from(info.iterations),
            seconds: self.seconds(),
            objective: info.cost_primal + self.offset,
            bound: f64::NEG_INFINITY,
            primal_residual: info.res_primal,
            dual_residual: info.res_dual,
            incumbent: std::ptr::null(),
            nodes: 0,
            open_nodes: 0,
        }
    }

    /// Clarabel asks us before it tests an iterate, which may be the answer: its own test.
    fn solved(&self, info: &DefaultInfo<f64>) -> bool {
        let [feasibility, gap_abs, gap_rel] = self.tolerances;
        info.ktratio <= 1.0
            && (info.gap_abs < gap_abs || info.gap_rel < gap_rel)
            && info.res_primal < feasibility
            && info.res_dual < feasibility
    }
}

/// Clarabel wants a callback that may cross threads and lives for ever. It runs on the thread that
/// called solve and is taken back before solve returns.
pub struct WatchPointer(pub *mut Watch);
unsafe impl Send for WatchPointer {}
unsafe impl Sync for WatchPointer {}

impl WatchPointer {
    /// # Safety
    /// The watch is alive and nobody else looks at it.
    pub unsafe fn look(&mut self, info: &DefaultInfo<f64>) -> bool {
        (*self.0).look(info)
    }
}

/// Lines to the host's log.
pub struct Log {
    host: sy_host,
    line: Vec<u8>,
}

// The host's log may be called from any thread.
unsafe impl Send for Log {}
unsafe impl Sync for Log {}

impl Log {
    pub fn new(host: sy_host) -> Log {
        Log { host, line: Vec::new() }
    }

    fn end_line(&mut self) {
        let text = CString::new(std::mem::take(&mut self.line)).unwrap_or_default();
        if let Some(log) = self.host.log {
            // SAFETY: the host's function, with its context.
            unsafe { log(self.host.context, SY_LOG_INFO, text.as_ptr()) };
        }
    }
}

impl io::Write for Log {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        for &byte in bytes {
            match byte {
                b'\n' => self.end_line(),
                _ => self.line.push(byte),
            }
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
