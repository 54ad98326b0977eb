//! The functions of FMI 2.0.4.
//!
//! `C calls => component`. Names and arguments are the standard's (`fmi2Functions.h`).

#![allow(unsafe_code, reason = "the functions that C calls")]
#![allow(non_snake_case, reason = "the standard's names")]

use std::ffi::{c_char, c_int, c_uint, c_void};

use crate::calls::{check_categories, free, instantiate};
use crate::component::Refusal;
use crate::exported::{exported, unsupported};
use crate::foreign::{Log, Logger2, c_text, read, slice, text, write};
use crate::location::folder;
use crate::states::{deserialize, free_state, get_state, serialize};
use crate::xml::Fmi;

/// `fmi2CoSimulation`.
const CO_SIMULATION: c_int = 1;
/// `fmi2StatusKind`.
const DO_STEP: c_int = 0;
const PENDING: c_int = 1;
const LAST_TIME: c_int = 2;
const TERMINATED: c_int = 3;

/// `fmi2CallbackFunctions`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Callbacks {
    /// The logger.
    pub logger: Option<Logger2>,
    /// Not used: the library has its own memory.
    pub allocate_memory: Option<unsafe extern "C" fn(usize, usize) -> *mut c_void>,
    /// Not used.
    pub free_memory: Option<unsafe extern "C" fn(*mut c_void)>,
    /// Not used: a step ends before its call returns.
    pub step_finished: Option<unsafe extern "C" fn(*mut c_void, c_int)>,
    /// The importer's environment.
    pub environment: *mut c_void,
}

/// `fmi2EventInfo`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct EventInfo {
    /// The five booleans, in the standard's order.
    pub flags: [c_int; 5],
    /// \[s\] the next event.
    pub next_event_time: f64,
}

/// `fmi2GetTypesPlatform`.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

/// `fmi2GetVersion`.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

/// `fmi2Instantiate`: a component; null, with a message in the log, if refused.
///
/// # Safety
/// Pointers are null or as required by the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    instance_name: *const c_char,
    kind: c_int,
    guid: *const c_char,
    resources: *const c_char,
    functions: *const Callbacks,
    _visible: c_int,
    _logging_on: c_int,
) -> *mut c_void {
    // SAFETY: as the caller promises.
    let texts = unsafe { (text(instance_name), text(guid), text(resources), read(functions)) };
    let (name, guid, resources, callbacks) = texts;
    let log = match callbacks {
        Ok(Callbacks { logger, environment, .. }) => {
            let name = c_text(name.as_deref().unwrap_or_default());
            Log::Two(logger, environment.expose_provenance(), name)
        }
        // There is no logger to report to.
        Err(_) => return std::ptr::null_mut(),
    };
    instantiate("fmi2Instantiate", log, Fmi::Two, || {
        if kind != CO_SIMULATION {
            return Err("this FMU is for co-simulation".into());
        }
        name.filter(|name| !name.is_empty()).ok_or("an instance needs a name")?;
        let resources = resources.ok_or("no resource location is given")?;
        Ok((folder(&resources)?, guid.ok_or("no GUID is given")?.into_owned()))
    })
}

/// `fmi2FreeInstance`: also frees its saved states.
///
/// # Safety
/// None: an invalid handle is detected.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(handle: *mut c_void) {
    free(handle);
}

/// Refuses to get or set variables of an unused type.
fn none_of(count: usize) -> Result<(), Refusal> {
    if count == 0 { Ok(()) } else { Err(Refusal::error("all variables of this FMU are Real")) }
}

/// Checks the status kind of a function.
fn is_kind(asked: c_int, kind: c_int) -> Result<(), Refusal> {
    if asked == kind {
        Ok(())
    } else {
        Err(Refusal::Error(format!("no status of kind {asked} has this type")))
    }
}

exported! {
    fn fmi2SetDebugLogging(_on: c_int, count: usize, categories: *const *const c_char) |_| {
        check_categories(slice(categories, count)?.iter().map(|name| text(*name)))
    };
    fn fmi2SetupExperiment(
        _tolerance_defined: c_int, _tolerance: f64, start: f64, _stop_defined: c_int, _stop: f64,
    ) |held| held.component.setup(start);
    fn fmi2EnterInitializationMode() |held| held.component.enter_initialization();
    fn fmi2ExitInitializationMode() |held| held.component.exit_initialization();
    fn fmi2Terminate() |held| held.component.terminate();
    fn fmi2Reset() |held| held.component.reset();
    fn fmi2GetReal(references: *const c_uint, count: usize, values: *mut f64) |held| {
        write(values, &held.component.get(slice(references, count)?)?)
    };
    fn fmi2GetInteger(_references: *const c_uint, count: usize, _values: *mut c_int) |_| none_of(count);
    fn fmi2GetBoolean(_references: *const c_uint, count: usize, _values: *mut c_int) |_| none_of(count);
    fn fmi2GetString(_references: *const c_uint, count: usize, _values: *mut *const c_char) |_| none_of(count);
    fn fmi2SetReal(references: *const c_uint, count: usize, values: *const f64) |held| {
        held.component.set(slice(references, count)?, slice(values, count)?)
    };
    fn fmi2SetInteger(_references: *const c_uint, count: usize, _values: *const c_int) |_| none_of(count);
    fn fmi2SetBoolean(_references: *const c_uint, count: usize, _values: *const c_int) |_| none_of(count);
    fn fmi2SetString(_references: *const c_uint, count: usize, _values: *const *const c_char) |_| none_of(count);
    fn fmi2GetFMUstate(state: *mut *mut c_void) |held| get_state(held, state);
    fn fmi2SetFMUstate(state: *mut c_void) |held| held.go_back(state.addr());
    fn fmi2FreeFMUstate(state: *mut *mut c_void) |held| free_state(held, state);
    fn fmi2SerializedFMUstateSize(state: *mut c_void, size: *mut usize) |held| {
        write(size, &[held.state(state.addr())?.len()])
    };
    fn fmi2SerializeFMUstate(state: *mut c_void, bytes: *mut u8, size: usize) |held| {
        serialize(held, state, bytes, size)
    };
    fn fmi2DeSerializeFMUstate(bytes: *const u8, size: usize, state: *mut *mut c_void) |held| {
        deserialize(held, bytes, size, state)
    };
    fn fmi2GetDirectionalDerivative(
        unknowns: *const c_uint, unknown_count: usize, knowns: *const c_uint, known_count: usize,
        seed: *const f64, sensitivity: *mut f64,
    ) |held| {
        let (unknowns, knowns) = (slice(unknowns, unknown_count)?, slice(knowns, known_count)?);
        let seed = slice(seed, known_count)?;
        write(sensitivity, &held.component.directional_derivative(unknowns, knowns, seed)?)
    };
    fn fmi2DoStep(point: f64, size: f64, _no_going_back: c_int) |held| held.step(point, size);
    fn fmi2GetStatus(kind: c_int, value: *mut c_int) |held| {
        is_kind(kind, DO_STEP)?;
        write(value, &[held.last_step.0])
    };
    fn fmi2GetRealStatus(kind: c_int, value: *mut f64) |held| {
        is_kind(kind, LAST_TIME)?;
        write(value, &[held.component.time()])
    };
    fn fmi2GetBooleanStatus(kind: c_int, value: *mut c_int) |_| {
        is_kind(kind, TERMINATED)?;
        write(value, &[0])
    };
    /// The text is valid until the next step.
    fn fmi2GetStringStatus(kind: c_int, value: *mut *const c_char) |held| {
        is_kind(kind, PENDING)?;
        write(value, &[held.last_step.1.as_ptr()])
    };
}

unsupported! {
    fn fmi2EnterEventMode();
    fn fmi2NewDiscreteStates(info: *mut EventInfo);
    fn fmi2EnterContinuousTimeMode();
    fn fmi2CompletedIntegratorStep(no_going_back: c_int, enter_event: *mut c_int, terminate: *mut c_int);
    fn fmi2SetTime(time: f64);
    fn fmi2SetContinuousStates(states: *const f64, count: usize);
    fn fmi2GetDerivatives(derivatives: *mut f64, count: usize);
    fn fmi2GetEventIndicators(indicators: *mut f64, count: usize);
    fn fmi2GetContinuousStates(states: *mut f64, count: usize);
    fn fmi2GetNominalsOfContinuousStates(nominals: *mut f64, count: usize);
    fn fmi2SetRealInputDerivatives(
        references: *const c_uint, count: usize, orders: *const c_int, values: *const f64,
    );
    fn fmi2GetRealOutputDerivatives(
        references: *const c_uint, count: usize, orders: *const c_int, values: *mut f64,
    );
    fn fmi2CancelStep();
    fn fmi2GetIntegerStatus(kind: c_int, value: *mut c_int);
}
