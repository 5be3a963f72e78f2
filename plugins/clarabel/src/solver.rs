//! An instance: one problem at a time in Clarabel's hands.

use std::time::Instant;

use clarabel::io::ConfigurablePrintTarget;
use clarabel::solver::{DefaultSolver, IPSolver, SolverError};

use crate::abi::*;
use crate::answer;
use crate::edge::{argument, failure, unsupported, Failure};
use crate::options::{Options, Settings};
use crate::problem::Problem;
use crate::watch::{Log, Watch, WatchPointer};

/// The kinds of update that Clarabel does in the factorization's pattern.
pub const UPDATES: u64 = SY_UPDATES_VECTORS | SY_UPDATES_VALUES;

pub struct Solver {
    host: sy_host,
    options: Options,
    loaded: Option<Loaded>,
}

struct Loaded {
    problem: Problem,
    updates: u64,
    // Away while it runs: a solver that a panic left half-way is not used again.
    clarabel: Option<DefaultSolver<f64>>,
}

impl Solver {
    pub fn new(host: sy_host) -> Solver {
        Solver { host, options: Options::new(), loaded: None }
    }

    /// # Safety
    /// A text in `value` is a C string.
    pub unsafe fn set_option(&mut self, name: &str, value: &sy_value) -> Result<(), Failure> {
        self.options.set(name, value)
    }

    /// # Safety
    /// As the header says of load: the problem stays in place.
    pub unsafe fn load(&mut self, problem: *const sy_problem, kinds: u64) -> Result<(), Failure> {
        self.loaded = None;
        let problem = Problem::new(problem)?;
        let updates = kinds & UPDATES;
        let clarabel = if problem.is_empty() {
            None
        } else {
            Some(build(&problem, self.options.settings(updates != 0))?)
        };
        self.loaded = Some(Loaded { problem, updates, clarabel });
        Ok(())
    }

    /// # Safety
    /// As the header says of update: the problem stays in place.
    pub unsafe fn update(&mut self, update: &sy_update) -> Result<(), Failure> {
        let loaded = self.loaded.as_mut().ok_or_else(|| not_loaded("update"))?;
        check_kinds(update, loaded.updates)?;
        if update.whole == 0 {
            return Ok(());
        }
        if update.problem.is_null() {
            return Err(argument(
                "update: whole sections are to be taken, but problem is NULL".into(),
            ));
        }
        let problem = Problem::new(update.problem)?;
        loaded.check_same_shape(&problem)?;
        if let Some(clarabel) = loaded.clarabel.as_mut() {
            refresh(clarabel, &problem, u64::from(update.whole))?;
        }
        loaded.problem = problem;
        Ok(())
    }

    /// # Safety
    /// As the header says of solve.
    pub unsafe fn solve(
        &mut self,
        control: &sy_control,
        result: &mut sy_result,
    ) -> Result<(), Failure> {
        let started = Instant::now();
        let loaded = self.loaded.as_mut().ok_or_else(|| not_loaded("solve"))?;
        if loaded.problem.is_empty() {
            answer::write_empty(loaded.problem.offset(), result);
            result.seconds = started.elapsed().as_secs_f64();
            return Ok(());
        }
        let settings = self.options.under(control, loaded.updates != 0);
        let mut clarabel = loaded.ready_to_run(&settings)?;
        if settings.verbose {
            clarabel.print_to_stream(Box::new(Log::new(self.host)));
        }
        let mut watch = Watch::new(*control, started, loaded.problem.offset(), &settings);
        let mut pointer = WatchPointer(&mut watch);
        clarabel.set_termination_callback(move |info| pointer.look(info));
        clarabel.solve();
        clarabel.unset_termination_callback();
        answer::write(&clarabel.solution, watch.stop(), &settings, &loaded.problem, result);
        result.seconds = started.elapsed().as_secs_f64();
        loaded.clarabel = Some(clarabel);
        Ok(())
    }
}

impl Loaded {
    /// Clarabel with these settings; built anew where they changed the shape of what was built.
    fn ready_to_run(&mut self, settings: &Settings) -> Result<DefaultSolver<f64>, Failure> {
        if let Some(mut built) = self.clarabel.take() {
            if built.update_settings(settings.clone()).is_ok() {
                return Ok(built);
            }
        }
        build(&self.problem, settings.clone())
    }

    fn check_same_shape(&self, problem: &Problem) -> Result<(), Failure> {
        let counts = |p: &Problem| {
            let (quadratic, rows) = p.nonzeros();
            [p.num_vars(), p.num_cone_rows(), quadratic, rows]
        };
        let (need, came) = (counts(&self.problem), counts(problem));
        if need == came {
            return Ok(());
        }
        Err(argument(format!(
            "update: variables, cone rows, entries of P and of F are to be {need:?} as loaded, \
             not {came:?}"
        )))
    }
}

fn build(problem: &Problem, settings: Settings) -> Result<DefaultSolver<f64>, Failure> {
    let cones = problem.cones()?;
    DefaultSolver::new(
        &problem.quadratic(),
        &problem.q(),
        &problem.rows(),
        &problem.g(),
        &cones,
        settings,
    )
    .map_err(|error| match error {
        SolverError::SettingsError(_) => argument(format!("clarabel: {error}")),
        _ => failure(SY_E_INTERNAL, format!("clarabel: {error}")),
    })
}

fn refresh(
    clarabel: &mut DefaultSolver<f64>,
    problem: &Problem,
    whole: u64,
) -> Result<(), Failure> {
    let refused = |error| failure(SY_E_INTERNAL, format!("clarabel: {error}"));
    if whole & SY_UPDATES_VECTORS != 0 {
        clarabel.update_q(&problem.q()).map_err(refused)?;
        clarabel.update_b(&problem.g()).map_err(refused)?;
    }
    if whole & SY_UPDATES_VALUES != 0 {
        let (quadratic, rows) = problem.values();
        clarabel.update_P(&quadratic).map_err(refused)?;
        clarabel.update_A(&rows).map_err(refused)?;
    }
    Ok(())
}

fn check_kinds(update: &sy_update, told: u64) -> Result<(), Failure> {
    let single = update.num_x | update.num_rows | update.num_cones | update.num_gone_rows;
    let other = single | update.num_gone_cones;
    if u64::from(update.whole) & !UPDATES != 0 || other != 0 || !update.more.is_null() {
        let text = "clarabel updates vectors and values in their patterns, nothing else";
        return Err(unsupported(text.into()));
    }
    if u64::from(update.whole) & !told != 0 {
        let text = "update: load was not told that updates of this kind would follow";
        return Err(failure(SY_E_STATE, text.into()));
    }
    Ok(())
}

fn not_loaded(call: &str) -> Failure {
    failure(SY_E_STATE, format!("{call}: no problem is loaded"))
}
