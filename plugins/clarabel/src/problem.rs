//! A sy_problem as Clarabel's data.
//!
//! The header has Fx + g in K, Clarabel Ax + s = b with s in K: A = -F, b = g. The rows of every
//! cone are in the same order in both, and Clarabel's dual z is the header's cone_dual:
//! Px + q + A'z = 0 is Px + q = F'z, with z in the dual cone.

use clarabel::algebra::CscMatrix;
use clarabel::solver::SupportedConeT;

use crate::abi::*;
use crate::edge::{argument, unsupported, Failure};

/// `count` values at `at`; none where the section is absent.
///
/// # Safety
/// `at` is null or points to `count` values.
pub unsafe fn slice<'a, T>(at: *const T, count: usize) -> &'a [T] {
    if at.is_null() {
        return &[];
    }
    std::slice::from_raw_parts(at, count)
}

/// A view of the problem that the host keeps in place until the next load or update.
pub struct Problem {
    record: sy_problem,
}

impl Problem {
    /// # Safety
    /// `problem` is a problem by rule 7 of the header and stays in place as long as this view.
    pub unsafe fn new(problem: *const sy_problem) -> Result<Problem, Failure> {
        let view = Problem { record: whole(problem) };
        view.check_sections()?;
        view.check_quadratic()?;
        view.check_cones()?;
        Ok(view)
    }

    pub fn num_vars(&self) -> usize {
        self.record.num_vars as usize
    }

    pub fn num_cone_rows(&self) -> usize {
        self.record.num_cone_rows as usize
    }

    pub fn is_empty(&self) -> bool {
        self.num_vars() + self.num_cone_rows() == 0
    }

    pub fn offset(&self) -> f64 {
        self.record.offset
    }

    pub fn q(&self) -> Vec<f64> {
        filled(self.record.q, self.num_vars())
    }

    pub fn g(&self) -> Vec<f64> {
        filled(self.record.g, self.num_cone_rows())
    }

    pub fn quadratic(&self) -> CscMatrix<f64> {
        matrix(self.record.P, self.num_vars(), self.num_vars(), 1.0)
    }

    pub fn rows(&self) -> CscMatrix<f64> {
        matrix(self.record.F, self.num_cone_rows(), self.num_vars(), -1.0)
    }

    /// The entries of P and of -F, in the order of their patterns.
    pub fn values(&self) -> (Vec<f64>, Vec<f64>) {
        (values(self.record.P, 1.0), values(self.record.F, -1.0))
    }

    /// The number of entries of P and of F.
    pub fn nonzeros(&self) -> (usize, usize) {
        (arrays(self.record.P).row.len(), arrays(self.record.F).row.len())
    }

    pub fn cones(&self) -> Result<Vec<SupportedConeT<f64>>, Failure> {
        self.cone_records().iter().enumerate().map(|(i, cone)| cone_of(i, cone)).collect()
    }

    fn cone_records(&self) -> &[sy_cone] {
        // SAFETY: the view's problem stays in place.
        unsafe { slice(self.record.cones, self.record.num_cones as usize) }
    }

    fn check_sections(&self) -> Result<(), Failure> {
        let p = &self.record;
        if p.num_vars < 0 || p.num_rows < 0 || p.num_cones < 0 || p.num_cone_rows < 0 {
            return Err(argument("the problem has a negative count".into()));
        }
        if p.num_rows > 0 {
            let came = p.num_rows;
            return Err(unsupported(format!("clarabel takes cones, no rows: {came} rows came")));
        }
        if !p.nlp.is_null() {
            return Err(unsupported("clarabel takes no nonlinear functions".into()));
        }
        // SAFETY: the view's problem stays in place.
        let (lower, upper, integer) = unsafe {
            let n = self.num_vars();
            (slice(p.x_lower, n), slice(p.x_upper, n), slice(p.integer, n))
        };
        let bounded = |b: &&[f64]| b.iter().position(|v| v.is_finite());
        if let Some(i) = [lower, upper].iter().find_map(bounded) {
            return Err(unsupported(format!("clarabel takes cones, no bounds: x[{i}] has one")));
        }
        if let Some(i) = integer.iter().position(|flag| *flag != 0) {
            return Err(unsupported(format!("clarabel takes no integers: x[{i}] is one")));
        }
        Ok(())
    }

    fn check_quadratic(&self) -> Result<(), Failure> {
        let n = self.num_vars();
        let p = check_shape("P", self.record.P, n, n)?;
        check_shape("F", self.record.F, self.num_cone_rows(), n)?;
        for j in 0..n.min(p.start.len().saturating_sub(1)) {
            let column = p.start[j] as usize..p.start[j + 1] as usize;
            if let Some(&i) = p.row[column].last().filter(|&&i| i as usize > j) {
                return Err(argument(format!("P holds its upper triangle: ({i}, {j}) is below")));
            }
        }
        if !p.row.is_empty() && self.record.flags & SY_PROBLEM_CONVEX == 0 {
            let text = "clarabel takes a convex quadratic objective: P is not known to be \
                        positive semidefinite";
            return Err(unsupported(text.into()));
        }
        Ok(())
    }

    fn check_cones(&self) -> Result<(), Failure> {
        self.cones()?;
        let rows: i64 = self.cone_records().iter().map(|cone| i64::from(cone.dim)).sum();
        if rows != i64::from(self.record.num_cone_rows) {
            let came = self.record.num_cone_rows;
            return Err(argument(format!("the cones take {rows} rows, but there are {came}")));
        }
        Ok(())
    }
}

fn cone_of(index: usize, cone: &sy_cone) -> Result<SupportedConeT<f64>, Failure> {
    let sy_cone { kind, dim, parameter } = *cone;
    let wrong_dim =
        |need: &str| argument(format!("cone[{index}]: its dimension is {need}, not {dim}"));
    let rows = usize::try_from(dim).map_err(|_| wrong_dim("at least 0"))?;
    match kind {
        SY_CONE_ZERO => Ok(SupportedConeT::ZeroConeT(rows)),
        SY_CONE_NONNEGATIVE => Ok(SupportedConeT::NonnegativeConeT(rows)),
        SY_CONE_SECOND_ORDER => Ok(SupportedConeT::SecondOrderConeT(rows)),
        #[cfg(feature = "psd")]
        SY_CONE_PSD => match order_of(rows) {
            Some(order) => Ok(SupportedConeT::PSDTriangleConeT(order)),
            None => Err(wrong_dim("k (k + 1) / 2 for a semidefinite cone")),
        },
        #[cfg(not(feature = "psd"))]
        SY_CONE_PSD => Err(unsupported(format!(
            "cone[{index}]: this clarabel was built without semidefinite cones (no BLAS and LAPACK)"
        ))),
        SY_CONE_EXPONENTIAL if dim == 3 => Ok(SupportedConeT::ExponentialConeT()),
        SY_CONE_POWER if dim == 3 && 0.0 < parameter && parameter < 1.0 => {
            Ok(SupportedConeT::PowerConeT(parameter))
        }
        SY_CONE_EXPONENTIAL | SY_CONE_POWER if dim != 3 => Err(wrong_dim("3")),
        SY_CONE_POWER => Err(unsupported(format!(
            "cone[{index}]: clarabel needs a power strictly between 0 and 1, not {parameter}"
        ))),
        _ => Err(unsupported(format!("cone[{index}]: clarabel has no cone of kind {kind}"))),
    }
}

/// The k with k (k + 1) / 2 = rows.
#[cfg(feature = "psd")]
fn order_of(rows: usize) -> Option<usize> {
    let k = (((8.0 * rows as f64 + 1.0).sqrt() - 1.0) / 2.0).round() as usize;
    (k * (k + 1) / 2 == rows).then_some(k)
}

struct Csc<'a> {
    start: &'a [i32],
    row: &'a [i32],
    value: &'a [f64],
}

/// The arrays of a matrix; empty where it is absent.
fn arrays<'a>(matrix: *const sy_csc) -> Csc<'a> {
    if matrix.is_null() {
        return Csc { start: &[], row: &[], value: &[] };
    }
    // SAFETY: rule 7: start has cols + 1 entries and ends with the number of nonzeros.
    unsafe {
        let m = &*matrix;
        let start = slice(m.start, m.cols as usize + 1);
        let nonzeros = start.last().map_or(0, |&end| end as usize);
        Csc { start, row: slice(m.row, nonzeros), value: slice(m.value, nonzeros) }
    }
}

fn check_shape<'a>(
    name: &str,
    matrix: *const sy_csc,
    rows: usize,
    cols: usize,
) -> Result<Csc<'a>, Failure> {
    // SAFETY: null, or in place.
    if let Some(m) = unsafe { matrix.as_ref() } {
        if (m.rows as usize, m.cols as usize) != (rows, cols) {
            let (r, c) = (m.rows, m.cols);
            return Err(argument(format!("{name} is to be {rows} x {cols}, not {r} x {c}")));
        }
    }
    Ok(arrays(matrix))
}

fn matrix(source: *const sy_csc, rows: usize, cols: usize, sign: f64) -> CscMatrix<f64> {
    if source.is_null() {
        return CscMatrix::zeros((rows, cols));
    }
    let wide = |list: &[i32]| list.iter().map(|&i| i as usize).collect();
    let Csc { start, row, .. } = arrays(source);
    CscMatrix::new(rows, cols, wide(start), wide(row), values(source, sign))
}

fn values(source: *const sy_csc, sign: f64) -> Vec<f64> {
    arrays(source).value.iter().map(|v| sign * v).collect()
}

fn filled(source: *const f64, count: usize) -> Vec<f64> {
    // SAFETY: null, or `count` values in place.
    match unsafe { slice(source, count) } {
        [] => vec![0.0; count],
        given => given.to_vec(),
    }
}
