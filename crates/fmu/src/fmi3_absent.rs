//! The functions of FMI 3.0.2 that this FMU does not support: other types, events, clocks, derivatives, other interface
//! types.
//!
//! `C calls => error, with the reason in the log`. Arguments are the standard's (`fmi3Functions.h`).

#![allow(unsafe_code, reason = "the functions that C calls")]
#![allow(non_snake_case, reason = "the standard's names")]
#![allow(clippy::too_many_arguments, reason = "the standard's")]

use std::ffi::{c_char, c_int, c_void};

use crate::calls::instantiate;
use crate::component::Refusal;
use crate::exported::{exported, unsupported};
use crate::fmi3::Boolean;
use crate::foreign::{Log, Logger3};
use crate::xml::Fmi;

/// `fmi3ClockUpdateCallback`.
pub type ClockUpdate = unsafe extern "C" fn(*mut c_void);
/// `fmi3LockPreemptionCallback`, `fmi3UnlockPreemptionCallback`.
pub type Preemption = unsafe extern "C" fn();

/// Refuses an instance of another interface type.
fn refused(function: &str, logger: Option<Logger3>, environment: *mut c_void) -> *mut c_void {
    let log = Log::Three(logger, environment.expose_provenance());
    instantiate(function, log, Fmi::Three, || Err("this FMU is for co-simulation".into()))
}

/// `fmi3InstantiateModelExchange`: null, with the reason in the log.
///
/// # Safety
/// Pointers are null or as required by the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    _instance_name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: Boolean,
    _logging_on: Boolean,
    environment: *mut c_void,
    logger: Option<Logger3>,
) -> *mut c_void {
    refused("fmi3InstantiateModelExchange", logger, environment)
}

/// `fmi3InstantiateScheduledExecution`: null, with the reason in the log.
///
/// # Safety
/// Pointers are null or as required by the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    _instance_name: *const c_char,
    _token: *const c_char,
    _resources: *const c_char,
    _visible: Boolean,
    _logging_on: Boolean,
    environment: *mut c_void,
    logger: Option<Logger3>,
    _clock_update: Option<ClockUpdate>,
    _lock: Option<Preemption>,
    _unlock: Option<Preemption>,
) -> *mut c_void {
    refused("fmi3InstantiateScheduledExecution", logger, environment)
}

/// Refuses to get or set variables of an unused type.
fn none_of(count: usize) -> Result<(), Refusal> {
    if count == 0 { Ok(()) } else { Err(Refusal::error("all variables of this FMU are Float64")) }
}

exported! {
    fn fmi3GetFloat32(_references: *const u32, count: usize, _values: *mut f32, _values_count: usize) |_| none_of(count);
    fn fmi3GetInt8(_references: *const u32, count: usize, _values: *mut i8, _values_count: usize) |_| none_of(count);
    fn fmi3GetUInt8(_references: *const u32, count: usize, _values: *mut u8, _values_count: usize) |_| none_of(count);
    fn fmi3GetInt16(_references: *const u32, count: usize, _values: *mut i16, _values_count: usize) |_| none_of(count);
    fn fmi3GetUInt16(_references: *const u32, count: usize, _values: *mut u16, _values_count: usize) |_| none_of(count);
    fn fmi3GetInt32(_references: *const u32, count: usize, _values: *mut i32, _values_count: usize) |_| none_of(count);
    fn fmi3GetUInt32(_references: *const u32, count: usize, _values: *mut u32, _values_count: usize) |_| none_of(count);
    fn fmi3GetInt64(_references: *const u32, count: usize, _values: *mut i64, _values_count: usize) |_| none_of(count);
    fn fmi3GetUInt64(_references: *const u32, count: usize, _values: *mut u64, _values_count: usize) |_| none_of(count);
    fn fmi3GetBoolean(_references: *const u32, count: usize, _values: *mut Boolean, _values_count: usize) |_| none_of(count);
    fn fmi3GetString(_references: *const u32, count: usize, _values: *mut *const c_char, _values_count: usize) |_| none_of(count);
    fn fmi3GetBinary(_references: *const u32, count: usize, _value_sizes: *mut usize, _values: *mut *const u8, _values_count: usize) |_| none_of(count);
    fn fmi3GetClock(_references: *const u32, count: usize, _values: *mut Boolean) |_| none_of(count);
    fn fmi3SetFloat32(_references: *const u32, count: usize, _values: *const f32, _values_count: usize) |_| none_of(count);
    fn fmi3SetInt8(_references: *const u32, count: usize, _values: *const i8, _values_count: usize) |_| none_of(count);
    fn fmi3SetUInt8(_references: *const u32, count: usize, _values: *const u8, _values_count: usize) |_| none_of(count);
    fn fmi3SetInt16(_references: *const u32, count: usize, _values: *const i16, _values_count: usize) |_| none_of(count);
    fn fmi3SetUInt16(_references: *const u32, count: usize, _values: *const u16, _values_count: usize) |_| none_of(count);
    fn fmi3SetInt32(_references: *const u32, count: usize, _values: *const i32, _values_count: usize) |_| none_of(count);
    fn fmi3SetUInt32(_references: *const u32, count: usize, _values: *const u32, _values_count: usize) |_| none_of(count);
    fn fmi3SetInt64(_references: *const u32, count: usize, _values: *const i64, _values_count: usize) |_| none_of(count);
    fn fmi3SetUInt64(_references: *const u32, count: usize, _values: *const u64, _values_count: usize) |_| none_of(count);
    fn fmi3SetBoolean(_references: *const u32, count: usize, _values: *const Boolean, _values_count: usize) |_| none_of(count);
    fn fmi3SetString(_references: *const u32, count: usize, _values: *const *const c_char, _values_count: usize) |_| none_of(count);
    fn fmi3SetBinary(_references: *const u32, count: usize, _value_sizes: *const usize, _values: *const *const u8, _values_count: usize) |_| none_of(count);
    fn fmi3SetClock(_references: *const u32, count: usize, _values: *const Boolean) |_| none_of(count);
}

unsupported! {
    fn fmi3EnterEventMode();
    fn fmi3GetNumberOfVariableDependencies(reference: u32, dependencies_count: *mut usize);
    fn fmi3GetVariableDependencies(dependent: u32, element_indices_of_dependent: *mut usize, independents: *mut u32, element_indices_of_independents: *mut usize, dependency_kinds: *mut c_int, dependencies_count: usize);
    fn fmi3GetAdjointDerivative(unknowns: *const u32, unknowns_count: usize, knowns: *const u32, knowns_count: usize, seed: *const f64, seed_count: usize, sensitivity: *mut f64, sensitivity_count: usize);
    fn fmi3EnterConfigurationMode();
    fn fmi3ExitConfigurationMode();
    fn fmi3GetIntervalDecimal(references: *const u32, count: usize, intervals: *mut f64, qualifiers: *mut c_int);
    fn fmi3GetIntervalFraction(references: *const u32, count: usize, counters: *mut u64, resolutions: *mut u64, qualifiers: *mut c_int);
    fn fmi3GetShiftDecimal(references: *const u32, count: usize, shifts: *mut f64);
    fn fmi3GetShiftFraction(references: *const u32, count: usize, counters: *mut u64, resolutions: *mut u64);
    fn fmi3SetIntervalDecimal(references: *const u32, count: usize, intervals: *const f64);
    fn fmi3SetIntervalFraction(references: *const u32, count: usize, counters: *const u64, resolutions: *const u64);
    fn fmi3SetShiftDecimal(references: *const u32, count: usize, shifts: *const f64);
    fn fmi3SetShiftFraction(references: *const u32, count: usize, counters: *const u64, resolutions: *const u64);
    fn fmi3EvaluateDiscreteStates();
    fn fmi3UpdateDiscreteStates(discrete_states_need_update: *mut Boolean, terminate_simulation: *mut Boolean, nominals_of_continuous_states_changed: *mut Boolean, values_of_continuous_states_changed: *mut Boolean, next_event_time_defined: *mut Boolean, next_event_time: *mut f64);
    fn fmi3EnterContinuousTimeMode();
    fn fmi3CompletedIntegratorStep(no_set_state_prior_to_current_point: Boolean, enter_event_mode: *mut Boolean, terminate_simulation: *mut Boolean);
    fn fmi3SetTime(time: f64);
    fn fmi3SetContinuousStates(continuous_states: *const f64, continuous_states_count: usize);
    fn fmi3GetContinuousStateDerivatives(derivatives: *mut f64, continuous_states_count: usize);
    fn fmi3GetEventIndicators(event_indicators: *mut f64, event_indicators_count: usize);
    fn fmi3GetContinuousStates(continuous_states: *mut f64, continuous_states_count: usize);
    fn fmi3GetNominalsOfContinuousStates(nominals: *mut f64, continuous_states_count: usize);
    fn fmi3GetNumberOfEventIndicators(event_indicators_count: *mut usize);
    fn fmi3GetNumberOfContinuousStates(continuous_states_count: *mut usize);
    fn fmi3EnterStepMode();
    fn fmi3GetOutputDerivatives(references: *const u32, count: usize, orders: *const i32, values: *mut f64, values_count: usize);
    fn fmi3ActivateModelPartition(clock_reference: u32, activation_time: f64);
}
