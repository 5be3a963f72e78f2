//! The records of switchyard/abi.h, field by field; what they mean is said there.
//!
//! `record!` also lists sizes and offsets, which the test below compares with the C compiler's.
#![allow(non_camel_case_types, non_snake_case)]

use std::ffi::c_void;
use std::os::raw::c_char;

pub const SY_OK: i32 = 0;
pub const SY_E_ARGUMENT: i32 = -1;
pub const SY_E_UNSUPPORTED: i32 = -2;
pub const SY_E_STATE: i32 = -3;
pub const SY_E_INTERNAL: i32 = -5;

pub const SY_CONE_ZERO: i32 = 0;
pub const SY_CONE_NONNEGATIVE: i32 = 1;
pub const SY_CONE_SECOND_ORDER: i32 = 2;
pub const SY_CONE_PSD: i32 = 3;
pub const SY_CONE_EXPONENTIAL: i32 = 4;
pub const SY_CONE_POWER: i32 = 5;

pub const SY_PROBLEM_CONVEX: u32 = 1 << 0;

pub const SY_NOT_SOLVED: i32 = 0;
pub const SY_OPTIMAL: i32 = 1;
pub const SY_INFEASIBLE: i32 = 3;
pub const SY_UNBOUNDED: i32 = 4;
pub const SY_ITERATION_LIMIT: i32 = 7;
pub const SY_TIME_LIMIT: i32 = 8;
pub const SY_CANCELLED: i32 = 10;
pub const SY_NUMERICAL_TROUBLE: i32 = 11;

pub const SY_NO_POINT: i32 = 0;
pub const SY_FEASIBLE: i32 = 1;
pub const SY_NEARLY_FEASIBLE: i32 = 2;
pub const SY_INFEASIBLE_POINT: i32 = 3;
pub const SY_CERTIFICATE: i32 = 4;

pub const SY_INTEGER: i32 = 0;
pub const SY_REAL: i32 = 1;
pub const SY_TEXT: i32 = 2;

pub const SY_LOG_INFO: i32 = 2;

pub const SY_ACCEPTS_QUADRATIC_OBJECTIVE: u64 = 1 << 2;

pub const SY_PROVES_GLOBAL: u64 = 1 << 2;
pub const SY_GIVES_DUALS: u64 = 1 << 3;
pub const SY_GIVES_CERTIFICATES: u64 = 1 << 4;

pub const SY_HONORS_THREADS: u64 = 1 << 0;
pub const SY_HONORS_SECONDS: u64 = 1 << 1;
pub const SY_HONORS_ITERATIONS: u64 = 1 << 2;
pub const SY_HONORS_FEASIBILITY: u64 = 1 << 6;
pub const SY_HONORS_OPTIMALITY: u64 = 1 << 7;
pub const SY_HONORS_VERBOSITY: u64 = 1 << 12;
pub const SY_HONORS_CANCELLED: u64 = 1 << 13;

pub const SY_UPDATES_VECTORS: u64 = 1 << 1;
pub const SY_UPDATES_VALUES: u64 = 1 << 2;

pub const SY_ABI_MAJOR: u16 = 1;
pub const SY_ABI_MINOR: u16 = 0;

macro_rules! record {
    ($name:ident { $($field:ident: $type:ty),* $(,)? }) => {
        #[repr(C)]
        #[derive(Clone, Copy)]
        pub struct $name {
            $(pub $field: $type,)*
        }

        #[cfg(test)]
        impl tests::Layout for $name {
            const NAME: &'static str = stringify!($name);
            fn offsets() -> Vec<(&'static str, usize)> {
                let place = std::mem::MaybeUninit::<$name>::uninit();
                let base = place.as_ptr();
                // SAFETY: addresses of fields are taken, nothing is read.
                vec![$((
                    stringify!($field),
                    unsafe { std::ptr::addr_of!((*base).$field) } as usize - base as usize,
                ),)*]
            }
        }
    };
}

pub type Instance = c_void; // sy_instance: the host only carries it

record!(sy_error { code: i32, text: [c_char; 1020] });

record!(sy_csc {
    rows: i32,
    cols: i32,
    start: *const i32,
    row: *const i32,
    value: *const f64,
});

record!(sy_cone { kind: i32, dim: i32, parameter: f64 });

record!(sy_problem {
    size: u32,
    num_vars: i32,
    num_rows: i32,
    num_cones: i32,
    num_cone_rows: i32,
    flags: u32,
    P: *const sy_csc,
    q: *const f64,
    offset: f64,
    x_lower: *const f64,
    x_upper: *const f64,
    integer: *const u8,
    A: *const sy_csc,
    row_lower: *const f64,
    row_upper: *const f64,
    F: *const sy_csc,
    g: *const f64,
    cones: *const sy_cone,
    nlp: *const c_void,
    hints: *const c_void,
});

record!(sy_result {
    size: u32,
    termination: i32,
    primal: i32,
    dual: i32,
    objective: f64,
    bound: f64,
    seconds: f64,
    iterations: i64,
    nodes: i64,
    x: *mut f64,
    x_dual: *mut f64,
    row_dual: *mut f64,
    cone_dual: *mut f64,
    nlp_dual: *mut f64,
    x_basis: *mut u8,
    row_basis: *mut u8,
    relaxed_x: *mut f64,
    relaxed: f64,
    text: *mut c_char,
    text_size: u64,
});

#[repr(C)]
#[derive(Clone, Copy)]
pub union sy_value_as {
    pub integer: i64,
    pub real: f64,
    pub text: *const c_char,
}

// The fields that are keywords of Rust, `type` and `as`, end in an underscore.
record!(sy_value { type_: i32, reserved: i32, as_: sy_value_as });

record!(sy_option {
    size: u32,
    reserved: u32,
    name: *const c_char,
    help: *const c_char,
    fallback: sy_value,
    lower: f64,
    upper: f64,
    choices: *const *const c_char,
});

record!(sy_progress {
    size: u32,
    reserved: u32,
    iteration: i64,
    seconds: f64,
    objective: f64,
    bound: f64,
    primal_residual: f64,
    dual_residual: f64,
    incumbent: *const f64,
    nodes: i64,
    open_nodes: i64,
});

record!(sy_control {
    size: u32,
    flags: u32,
    threads: i32,
    verbosity: i32,
    seconds: f64,
    iterations: i64,
    nodes: i64,
    cutoff: f64,
    target: f64,
    feasibility: f64,
    optimality: f64,
    integrality: f64,
    absolute_gap: f64,
    relative_gap: f64,
    seed: u64,
    context: *mut c_void,
    progress: Option<unsafe extern "C" fn(*mut c_void, *const sy_progress) -> i32>,
    cancelled: Option<unsafe extern "C" fn(*mut c_void) -> i32>,
});

record!(sy_host {
    size: u32,
    abi_major: u16,
    abi_minor: u16,
    name: *const c_char,
    version: *const c_char,
    context: *mut c_void,
    log: Option<unsafe extern "C" fn(*mut c_void, i32, *const c_char)>,
    extension: Option<unsafe extern "C" fn(*mut c_void, *const c_char) -> *const c_void>,
    setting: Option<
        unsafe extern "C" fn(*mut c_void, *const c_char, *const c_char) -> *const c_char,
    >,
});

record!(sy_update {
    size: u32,
    whole: u32,
    problem: *const sy_problem,
    num_x: i32,
    num_rows: i32,
    num_cones: i32,
    num_gone_rows: i32,
    x: *const i32,
    x_lower: *const f64,
    x_upper: *const f64,
    row: *const i32,
    row_lower: *const f64,
    row_upper: *const f64,
    cone: *const i32,
    cone_on: *const u8,
    gone_row: *const i32,
    gone_cone: *const i32,
    num_gone_cones: i32,
    reserved: i32,
    more: *const c_void,
});

record!(sy_facts { size: u32, reserved: u32, version: [c_char; 64], text: [c_char; 448] });

record!(sy_solver {
    size: u32,
    reserved: u32,
    context: *const c_void,
    id: *const c_char,
    name: *const c_char,
    version: *const c_char,
    license: *const c_char,
    accepts: u64,
    cones: u64,
    integer_accepts: u64,
    integer_cones: u64,
    traits: u64,
    honors: u64,
    updates: u64,
    options: *const *const sy_option,
    create: Option<
        unsafe extern "C" fn(
            *const sy_solver,
            *const sy_host,
            *mut *mut Instance,
            *mut sy_error,
        ) -> i32,
    >,
    destroy: Option<unsafe extern "C" fn(*mut Instance)>,
    set_option: Option<
        unsafe extern "C" fn(*mut Instance, *const c_char, *const sy_value, *mut sy_error) -> i32,
    >,
    load: Option<
        unsafe extern "C" fn(*mut Instance, *const sy_problem, u64, *mut sy_error) -> i32,
    >,
    solve: Option<
        unsafe extern "C" fn(
            *mut Instance,
            *const sy_control,
            *mut sy_result,
            *mut sy_error,
        ) -> i32,
    >,
    ready: Option<
        unsafe extern "C" fn(
            *const sy_solver,
            *const sy_host,
            *mut sy_facts,
            *mut sy_error,
        ) -> i32,
    >,
    supports: Option<
        unsafe extern "C" fn(
            *const sy_solver,
            *const sy_host,
            *const sy_problem,
            *mut sy_error,
        ) -> i32,
    >,
    update: Option<unsafe extern "C" fn(*mut Instance, *const sy_update, *mut sy_error) -> i32>,
    warm_start: Option<unsafe extern "C" fn(*mut Instance, *const c_void, *mut sy_error) -> i32>,
    clone: Option<
        unsafe extern "C" fn(*mut Instance, *mut *mut Instance, *mut sy_error) -> i32,
    >,
    extension: Option<unsafe extern "C" fn(*const sy_solver, *const c_char) -> *const c_void>,
});

record!(sy_plugin {
    size: u32,
    abi_major: u16,
    abi_minor: u16,
    name: *const c_char,
    version: *const c_char,
    solvers: *const *const sy_solver,
    extension: Option<unsafe extern "C" fn(*const c_char) -> *const c_void>,
});

/// A record starts with the sizeof its author compiled with.
///
/// # Safety
/// All zeros are a value of it.
pub unsafe trait Record: Copy {}
unsafe impl Record for sy_problem {}
unsafe impl Record for sy_result {}
unsafe impl Record for sy_control {}
unsafe impl Record for sy_host {}
unsafe impl Record for sy_update {}
unsafe impl Record for sy_facts {}

/// The record with every field of today: those its author did not know are zero.
///
/// # Safety
/// `given` points to a record of the size it states.
pub unsafe fn whole<R: Record>(given: *const R) -> R {
    let mut record = std::mem::zeroed::<R>();
    copy_known(given, &mut record, size_of_record(given));
    record
}

/// Writes back what the owner of `given` knows of `record`; its size stays its own.
///
/// # Safety
/// `given` points to a record of the size it states.
pub unsafe fn write_back<R: Record>(record: &R, given: *mut R) {
    let size = size_of_record(given);
    copy_known(record, given, size);
    given.cast::<u32>().write(size);
}

unsafe fn size_of_record<R: Record>(given: *const R) -> u32 {
    given.cast::<u32>().read()
}

unsafe fn copy_known<R: Record>(from: *const R, to: *mut R, known: u32) {
    let bytes = std::mem::size_of::<R>().min(known as usize);
    std::ptr::copy_nonoverlapping(from.cast::<u8>(), to.cast::<u8>(), bytes);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fmt::Write as _;
    use std::process::Command;

    pub trait Layout {
        const NAME: &'static str;
        fn offsets() -> Vec<(&'static str, usize)>;
    }

    /// Adds to `ours` the layout here, and to `asks` the C statements that print the header's.
    fn describe<R: Layout>(ours: &mut String, asks: &mut String) {
        let name = R::NAME;
        writeln!(ours, "{name} {}", std::mem::size_of::<R>()).unwrap();
        writeln!(asks, "printf(\"{name} %zu\\n\", sizeof({name}));").unwrap();
        for (field, offset) in R::offsets() {
            let field = field.trim_end_matches('_');
            writeln!(ours, "{name}.{field} {offset}").unwrap();
            writeln!(asks, "printf(\"{name}.{field} %zu\\n\", offsetof({name}, {field}));")
                .unwrap();
        }
    }

    #[test]
    fn records_lie_as_the_c_compiler_lays_them() {
        let (mut ours, mut asks) = (String::new(), String::new());
        describe::<sy_error>(&mut ours, &mut asks);
        describe::<sy_csc>(&mut ours, &mut asks);
        describe::<sy_cone>(&mut ours, &mut asks);
        describe::<sy_problem>(&mut ours, &mut asks);
        describe::<sy_result>(&mut ours, &mut asks);
        describe::<sy_value>(&mut ours, &mut asks);
        describe::<sy_option>(&mut ours, &mut asks);
        describe::<sy_progress>(&mut ours, &mut asks);
        describe::<sy_control>(&mut ours, &mut asks);
        describe::<sy_host>(&mut ours, &mut asks);
        describe::<sy_update>(&mut ours, &mut asks);
        describe::<sy_facts>(&mut ours, &mut asks);
        describe::<sy_solver>(&mut ours, &mut asks);
        describe::<sy_plugin>(&mut ours, &mut asks);

        let folder = std::env::temp_dir().join(format!("sy_layout_{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let (source, program) = (folder.join("layout.c"), folder.join("layout"));
        let text = format!(
            "#include <stdio.h>\n#include \"switchyard/abi.h\"\n\
             int main(void) {{\n{asks}return 0; }}\n"
        );
        std::fs::write(&source, text).unwrap();
        let include = concat!(env!("CARGO_MANIFEST_DIR"), "/../../include");
        let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".into());
        let compiled = Command::new(compiler)
            .args(["-std=c99", "-I", include, "-o"])
            .args([&program, &source])
            .status()
            .unwrap();
        assert!(compiled.success());
        let theirs = String::from_utf8(Command::new(&program).output().unwrap().stdout).unwrap();
        std::fs::remove_dir_all(&folder).unwrap();
        assert_eq!(ours, theirs);
    }
}
