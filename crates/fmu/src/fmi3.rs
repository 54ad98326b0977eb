//! The functions of FMI 3.0.2 that this FMU supports; the others are in `fmi3_absent`.
//!
//! `C calls => component`. Names and arguments are the standard's (`fmi3Functions.h`).

#![allow(unsafe_code, reason = "the functions that C calls")]
#![allow(non_snake_case, reason = "the standard's names")]

use std::ffi::{c_char, c_int, c_void};

use crate::calls::{check_categories, free, instantiate};
use crate::component::Refusal;
use crate::exported::exported;
use crate::foreign::{Log, Logger3, slice, text, write};
use crate::location::folder;
use crate::states::{deserialize, free_state, get_state, serialize};
use crate::xml::Fmi;

/// `fmi3Boolean`: C's `bool`, for which a C caller may pass any byte.
pub type Boolean = u8;
/// `fmi3IntermediateUpdateCallback`.
pub type IntermediateUpdate = unsafe extern "C" fn(
    *mut c_void,
    f64,
    Boolean,
    Boolean,
    Boolean,
    Boolean,
    *mut Boolean,
    *mut f64,
);

/// `fmi3GetVersion`.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

/// `fmi3InstantiateCoSimulation`: a component; null, with a message in the log, if refused.
///
/// # Safety
/// Pointers are null or as required by the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    instance_name: *const c_char,
    token: *const c_char,
    resources: *const c_char,
    _visible: Boolean,
    _logging_on: Boolean,
    event_mode: Boolean,
    _early_return: Boolean,
    _intermediate: *const u32,
    intermediate_count: usize,
    environment: *mut c_void,
    logger: Option<Logger3>,
    _intermediate_update: Option<IntermediateUpdate>,
) -> *mut c_void {
    // SAFETY: as the caller promises.
    let (name, token, resources) = unsafe { (text(instance_name), text(token), text(resources)) };
    let log = Log::Three(logger, environment.expose_provenance());
    instantiate("fmi3InstantiateCoSimulation", log, Fmi::Three, || {
        name.filter(|name| !name.is_empty()).ok_or("an instance needs a name")?;
        if event_mode != 0 || intermediate_count != 0 {
            return Err("this FMU has neither events nor intermediate variables".into());
        }
        let resources = resources.ok_or("no resource location is given")?;
        Ok((folder(&resources)?, token.ok_or("no token is given")?.into_owned()))
    })
}

/// `fmi3FreeInstance`: also frees its saved states.
///
/// # Safety
/// None: an invalid handle is detected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(handle: *mut c_void) {
    free(handle);
}

/// Checks that there is one value for each reference: no variable is an array.
fn same_count(count: usize, values: usize) -> Result<(), Refusal> {
    if count == values {
        return Ok(());
    }
    Err(Refusal::Error(format!("{values} values for {count} variables, none of which is an array")))
}

exported! {
    fn fmi3SetDebugLogging(_on: Boolean, count: usize, categories: *const *const c_char) |_| {
        check_categories(slice(categories, count)?.iter().map(|name| text(*name)))
    };
    fn fmi3EnterInitializationMode(
        _tolerance_defined: Boolean, _tolerance: f64, start: f64, _stop_defined: Boolean, _stop: f64,
    ) |held| {
        held.component.setup(start)?;
        held.component.enter_initialization()
    };
    fn fmi3ExitInitializationMode() |held| held.component.exit_initialization();
    fn fmi3Terminate() |held| held.component.terminate();
    fn fmi3Reset() |held| held.component.reset();
    fn fmi3GetFloat64(references: *const u32, count: usize, values: *mut f64, value_count: usize) |held| {
        same_count(count, value_count)?;
        write(values, &held.component.get(slice(references, count)?)?)
    };
    fn fmi3SetFloat64(references: *const u32, count: usize, values: *const f64, value_count: usize) |held| {
        same_count(count, value_count)?;
        held.component.set(slice(references, count)?, slice(values, count)?)
    };
    fn fmi3GetFMUState(state: *mut *mut c_void) |held| get_state(held, state);
    fn fmi3SetFMUState(state: *mut c_void) |held| held.go_back(state.addr());
    fn fmi3FreeFMUState(state: *mut *mut c_void) |held| free_state(held, state);
    fn fmi3SerializedFMUStateSize(state: *mut c_void, size: *mut usize) |held| {
        write(size, &[held.state(state.addr())?.len()])
    };
    fn fmi3SerializeFMUState(state: *mut c_void, bytes: *mut u8, size: usize) |held| {
        serialize(held, state, bytes, size)
    };
    fn fmi3DeserializeFMUState(bytes: *const u8, size: usize, state: *mut *mut c_void) |held| {
        deserialize(held, bytes, size, state)
    };
    fn fmi3GetDirectionalDerivative(
        unknowns: *const u32, unknown_count: usize, knowns: *const u32, known_count: usize,
        seed: *const f64, seed_count: usize, sensitivity: *mut f64, sensitivity_count: usize,
    ) |held| {
        same_count(known_count, seed_count)?;
        same_count(unknown_count, sensitivity_count)?;
        let (unknowns, knowns) = (slice(unknowns, unknown_count)?, slice(knowns, known_count)?);
        let seed = slice(seed, seed_count)?;
        write(sensitivity, &held.component.directional_derivative(unknowns, knowns, seed)?)
    };
    fn fmi3DoStep(
        point: f64, size: f64, _no_going_back: Boolean, event: *mut Boolean, terminate: *mut Boolean,
        early: *mut Boolean, last_time: *mut f64,
    ) |held| {
        for flag in [event, terminate, early] {
            write(flag, &[0])?;
        }
        let done = held.step(point, size);
        write(last_time, &[held.component.time()])?;
        done
    };
}
