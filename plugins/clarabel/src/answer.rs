//! What Clarabel found, in the terms of the header: never more than it says.

use clarabel::solver::{DefaultSolution, SolverStatus};

use crate::abi::*;
use crate::edge::put_text;
use crate::options::Settings;
use crate::problem::Problem;
use crate::watch::Stop;

/// Fills in the result, but for its seconds.
///
/// # Safety
/// The buffers of `result` are null or as long as the header says.
pub unsafe fn write(
    found: &DefaultSolution<f64>,
    stop: Stop,
    settings: &Settings,
    problem: &Problem,
    result: &mut sy_result,
) {
    result.termination = termination(found, stop, settings);
    result.bound = f64::NEG_INFINITY;
    result.objective = f64::NAN;
    result.relaxed = f64::NAN;
    result.iterations = i64::from(found.iterations);
    result.nodes = 0;
    let (primal, dual) = match found.status {
        SolverStatus::PrimalInfeasible => (None, ray(&found.z, &problem.g())),
        SolverStatus::DualInfeasible => (ray(&found.x, &problem.q()), None),
        // Neither an iterate nor a certificate that Clarabel vouches for.
        SolverStatus::Unsolved
        | SolverStatus::AlmostPrimalInfeasible
        | SolverStatus::AlmostDualInfeasible => (None, None),
        _ => (iterate(&found.x, found.r_prim, settings), iterate(&found.z, found.r_dual, settings)),
    };
    if primal.as_ref().is_some_and(|point| point.kind != SY_CERTIFICATE) {
        result.objective = found.obj_val + problem.offset();
    }
    if result.termination == SY_UNBOUNDED {
        result.objective = f64::NEG_INFINITY;
    }
    result.primal = put_point(primal, result.x);
    result.dual = put_point(dual, result.cone_dual);
    if result.dual != SY_NO_POINT && !result.x_dual.is_null() {
        std::slice::from_raw_parts_mut(result.x_dual, problem.num_vars()).fill(0.0);
    }
    put_text(&format!("{:?}", found.status), result.text, result.text_size as usize);
}

/// The answer to a problem without variables and rows, which Clarabel cannot be given.
///
/// # Safety
/// The text of `result` is null or as long as it says.
pub unsafe fn write_empty(offset: f64, result: &mut sy_result) {
    result.termination = SY_OPTIMAL;
    result.primal = SY_FEASIBLE;
    result.dual = SY_FEASIBLE;
    result.objective = offset;
    result.bound = offset;
    result.relaxed = f64::NAN;
    result.iterations = 0;
    result.nodes = 0;
    put_text("no variables and no rows", result.text, result.text_size as usize);
}

fn termination(found: &DefaultSolution<f64>, stop: Stop, settings: &Settings) -> i32 {
    match found.status {
        SolverStatus::Unsolved => SY_NOT_SOLVED,
        SolverStatus::Solved => SY_OPTIMAL,
        SolverStatus::PrimalInfeasible => SY_INFEASIBLE,
        SolverStatus::DualInfeasible => SY_UNBOUNDED,
        SolverStatus::MaxIterations => SY_ITERATION_LIMIT,
        SolverStatus::MaxTime => SY_TIME_LIMIT,
        SolverStatus::CallbackTerminated if stop == Stop::Deadline => SY_TIME_LIMIT,
        SolverStatus::CallbackTerminated => SY_CANCELLED,
        SolverStatus::NumericalError | SolverStatus::InsufficientProgress => SY_NUMERICAL_TROUBLE,
        SolverStatus::AlmostSolved
        | SolverStatus::AlmostPrimalInfeasible
        | SolverStatus::AlmostDualInfeasible => {
            // A limit reached near an answer has one of these names too.
            if found.iterations >= settings.max_iter {
                SY_ITERATION_LIMIT
            } else if found.solve_time > settings.time_limit {
                SY_TIME_LIMIT
            } else {
                SY_NUMERICAL_TROUBLE
            }
        }
    }
}

struct Point {
    kind: i32,
    values: Vec<f64>,
}

/// An iterate is what its relative residual says. Slacks and duals are inside their cones always.
fn iterate(values: &[f64], residual: f64, settings: &Settings) -> Option<Point> {
    let kind = if residual < settings.tol_feas {
        SY_FEASIBLE
    } else if residual < settings.reduced_tol_feas {
        SY_NEARLY_FEASIBLE
    } else {
        SY_INFEASIBLE_POINT
    };
    point(kind, values.to_vec())
}

/// A certificate scaled so that it improves its objective by 1: -g'z = 1 for a Farkas dual, and
/// -q'x = 1 for a ray.
fn ray(direction: &[f64], slope: &[f64]) -> Option<Point> {
    let gain: f64 = -direction.iter().zip(slope).map(|(d, s)| d * s).sum::<f64>();
    if gain <= 0.0 {
        return None;
    }
    point(SY_CERTIFICATE, direction.iter().map(|d| d / gain).collect())
}

fn point(kind: i32, values: Vec<f64>) -> Option<Point> {
    values.iter().all(|v| v.is_finite()).then_some(Point { kind, values })
}

unsafe fn put_point(point: Option<Point>, buffer: *mut f64) -> i32 {
    let Some(point) = point else {
        return SY_NO_POINT;
    };
    if !buffer.is_null() {
        buffer.copy_from_nonoverlapping(point.values.as_ptr(), point.values.len());
    }
    point.kind
}
