//! The C edge: the table, and the one place where failures and panics become a status and a text.

use std::any::Any;
use std::ffi::CStr;
use std::mem::size_of;
use std::os::raw::c_char;
use std::panic::{catch_unwind, set_hook, AssertUnwindSafe};
use std::ptr::null;
use std::sync::{Once, OnceLock};

use crate::abi::*;
use crate::options::{c_text, table};
use crate::problem::Problem;
use crate::solver::{Solver, UPDATES};

const VERSION: &str = "0.11.1"; // of the crate clarabel, as Cargo.toml asks for it

const FACTS: &str = if cfg!(feature = "psd") {
    "built in; linear systems by QDLDL on one thread; semidefinite cones through the system's BLAS \
     and LAPACK; stops between iterations"
} else {
    "built in, without semidefinite cones; linear systems by QDLDL on one thread; stops between \
     iterations"
};

/// Why a call failed.
pub struct Failure {
    code: i32,
    text: String,
}

pub fn failure(code: i32, text: String) -> Failure {
    Failure { code, text }
}

pub fn argument(text: String) -> Failure {
    failure(SY_E_ARGUMENT, text)
}

pub fn unsupported(text: String) -> Failure {
    failure(SY_E_UNSUPPORTED, text)
}

/// Copies as much of `text` as fits, and the ending zero.
///
/// # Safety
/// `buffer` is null or has `size` bytes.
pub unsafe fn put_text(text: &str, buffer: *mut c_char, size: usize) {
    if buffer.is_null() || size == 0 {
        return;
    }
    let mut length = text.len().min(size - 1);
    while !text.is_char_boundary(length) {
        length -= 1;
    }
    buffer.copy_from_nonoverlapping(text.as_ptr().cast::<c_char>(), length);
    buffer.add(length).write(0);
}

/// Runs `body`; what fails or panics in it becomes a status and a text.
unsafe fn guarded(error: *mut sy_error, body: impl FnOnce() -> Result<(), Failure>) -> i32 {
    let failed = match catch_unwind(AssertUnwindSafe(body)) {
        Ok(Ok(())) => return SY_OK,
        Ok(Err(failed)) => failed,
        Err(panic) => failure(SY_E_INTERNAL, format!("clarabel: {}", said(&*panic))),
    };
    if let Some(error) = error.as_mut() {
        error.code = failed.code;
        put_text(&failed.text, error.text.as_mut_ptr(), error.text.len());
    }
    failed.code
}

fn said(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("a panic without a message")
}

/// What a panic says is in the error; the module's own copy of the runtime prints nothing.
fn silence_panics() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| set_hook(Box::new(|_| {})));
}

unsafe fn as_solver<'a>(instance: *mut Instance) -> &'a mut Solver {
    &mut *instance.cast::<Solver>()
}

unsafe extern "C" fn create(
    _: *const sy_solver,
    host: *const sy_host,
    out: *mut *mut Instance,
    error: *mut sy_error,
) -> i32 {
    silence_panics();
    guarded(error, || {
        *out = Box::into_raw(Box::new(Solver::new(whole(host)))).cast();
        Ok(())
    })
}

unsafe extern "C" fn destroy(instance: *mut Instance) {
    guarded(std::ptr::null_mut(), || {
        if !instance.is_null() {
            drop(Box::from_raw(instance.cast::<Solver>()));
        }
        Ok(())
    });
}

unsafe extern "C" fn set_option(
    instance: *mut Instance,
    name: *const c_char,
    value: *const sy_value,
    error: *mut sy_error,
) -> i32 {
    guarded(error, || {
        let name = CStr::from_ptr(name).to_string_lossy();
        as_solver(instance).set_option(&name, &*value)
    })
}

unsafe extern "C" fn load(
    instance: *mut Instance,
    problem: *const sy_problem,
    updates: u64,
    error: *mut sy_error,
) -> i32 {
    guarded(error, || as_solver(instance).load(problem, updates))
}

unsafe extern "C" fn update(
    instance: *mut Instance,
    update: *const sy_update,
    error: *mut sy_error,
) -> i32 {
    guarded(error, || as_solver(instance).update(&whole(update)))
}

unsafe extern "C" fn solve(
    instance: *mut Instance,
    control: *const sy_control,
    result: *mut sy_result,
    error: *mut sy_error,
) -> i32 {
    guarded(error, || {
        let mut found = whole(result);
        as_solver(instance).solve(&whole(control), &mut found)?;
        write_back(&found, result);
        Ok(())
    })
}

unsafe extern "C" fn ready(
    _: *const sy_solver,
    _: *const sy_host,
    facts: *mut sy_facts,
    error: *mut sy_error,
) -> i32 {
    guarded(error, || {
        let mut known = whole(facts);
        put_text(VERSION, known.version.as_mut_ptr(), known.version.len());
        put_text(FACTS, known.text.as_mut_ptr(), known.text.len());
        write_back(&known, facts);
        Ok(())
    })
}

unsafe extern "C" fn supports(
    _: *const sy_solver,
    _: *const sy_host,
    problem: *const sy_problem,
    error: *mut sy_error,
) -> i32 {
    guarded(error, || Problem::new(problem).map(drop))
}

fn cones() -> u64 {
    let psd = if cfg!(feature = "psd") { 1 << SY_CONE_PSD } else { 0 };
    (1 << SY_CONE_ZERO)
        | (1 << SY_CONE_NONNEGATIVE)
        | (1 << SY_CONE_SECOND_ORDER)
        | (1 << SY_CONE_EXPONENTIAL)
        | (1 << SY_CONE_POWER)
        | psd
}

fn solver() -> sy_solver {
    sy_solver {
        size: size_of::<sy_solver>() as u32,
        reserved: 0,
        context: null(),
        id: c_text("org.oxfordcontrol.clarabel"),
        name: c_text("clarabel"),
        version: c_text(VERSION),
        license: c_text("Apache-2.0"),
        accepts: SY_ACCEPTS_QUADRATIC_OBJECTIVE,
        cones: cones(),
        integer_accepts: 0,
        integer_cones: 0,
        traits: SY_PROVES_GLOBAL | SY_GIVES_DUALS | SY_GIVES_CERTIFICATES,
        honors: SY_HONORS_THREADS
            | SY_HONORS_SECONDS
            | SY_HONORS_ITERATIONS
            | SY_HONORS_FEASIBILITY
            | SY_HONORS_OPTIMALITY
            | SY_HONORS_VERBOSITY
            | SY_HONORS_CANCELLED,
        updates: UPDATES,
        options: table(),
        create: Some(create),
        destroy: Some(destroy),
        set_option: Some(set_option),
        load: Some(load),
        solve: Some(solve),
        ready: Some(ready),
        supports: Some(supports),
        update: Some(update),
        warm_start: None,
        clone: None,
        extension: None,
    }
}

/// Constant once made, and reached only through pointers to const.
struct Shared(*const sy_plugin);
unsafe impl Send for Shared {}
unsafe impl Sync for Shared {}

#[no_mangle]
pub extern "C" fn switchyard_plugin_v1() -> *const sy_plugin {
    static PLUGIN: OnceLock<Shared> = OnceLock::new();
    let made = PLUGIN.get_or_init(|| {
        let solver: &sy_solver = Box::leak(Box::new(solver()));
        let solvers = Box::leak(Box::new([solver as *const sy_solver, null()]));
        Shared(Box::leak(Box::new(sy_plugin {
            size: size_of::<sy_plugin>() as u32,
            abi_major: SY_ABI_MAJOR,
            abi_minor: SY_ABI_MINOR,
            name: c_text("clarabel"),
            version: c_text(env!("CARGO_PKG_VERSION")),
            solvers: solvers.as_ptr(),
            extension: None,
        })))
    });
    made.0
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_version_told_is_the_one_built_in() {
        let lock = include_str!("../Cargo.lock");
        let entry = format!("name = \"clarabel\"\nversion = \"{}\"\n", super::VERSION);
        assert!(lock.contains(&entry));
    }
}
