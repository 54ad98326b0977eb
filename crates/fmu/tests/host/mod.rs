//! A host as an importer is one: it knows the functions of the standards, handles and value references.

#![allow(unsafe_code, reason = "a caller in C")]
#![allow(dead_code, reason = "no test uses all of it")]

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr::{null, null_mut};
use std::sync::Mutex;

use dbd_fmu::calls::{ERROR, OK};
use dbd_fmu::description::Description;
use dbd_fmu::fmi2::{self, Callbacks};
use dbd_fmu::foreign::{Logger2, Logger3};
use dbd_fmu::resource::Resource;
use dbd_fmu::token::token;
use dbd_fmu::{Fmi, fmi3};
use dbd_plant::instance::{Blueprint, Settings};

pub type Messages = Mutex<Vec<String>>;

unsafe extern "C" fn log2(
    environment: *mut c_void,
    _name: *const c_char,
    _status: c_int,
    _category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the messages of the host, and a text.
    let (messages, text) = unsafe { (&*environment.cast::<Messages>(), CStr::from_ptr(message)) };
    messages.lock().unwrap().push(text.to_str().unwrap().to_owned());
}

unsafe extern "C" fn log3(
    environment: *mut c_void,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the same.
    unsafe { log2(environment, null(), status, category, message) }
}

/// An unpacked FMU.
pub struct Unpacked {
    pub folder: tempfile::TempDir,
    pub token: String,
    pub fmi: Fmi,
    pub description: Description,
}

pub fn scene(name: &str) -> Blueprint {
    let file = format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Blueprint::load(Path::new(&file)).unwrap()
}

pub fn unpacked(blueprint: Blueprint, settings: Settings, fmi: Fmi) -> Unpacked {
    let (resource, instance) = Resource::new(blueprint, settings).unwrap();
    let description = Description::of(&instance).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in resource.files() {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    Unpacked { folder, token: token(&description, &resource, fmi), fmi, description }
}

impl Unpacked {
    pub fn reference(&self, name: &str) -> u32 {
        let found = self.description.variables.iter().position(|variable| variable.name == name);
        found.unwrap_or_else(|| panic!("no variable {name}")) as u32
    }

    /// An instance as it is after initialisation.
    pub fn stepping(&self) -> Host<'_> {
        let host = self.host();
        assert_eq!(host.initialize(), OK, "{}", host.said());
        host
    }

    pub fn host(&self) -> Host<'_> {
        let host = self.try_host(&self.token);
        assert!(!host.handle.is_null(), "{}", host.said());
        host
    }

    pub fn try_host(&self, token: &str) -> Host<'_> {
        let messages = Box::new(Messages::default());
        let environment = std::ptr::from_ref(&*messages).cast_mut().cast();
        let (name, token) = (c"plant", CString::new(token).unwrap());
        let path = self.folder.path().to_str().unwrap();
        // SAFETY: texts, and functions of this file; on all our systems a function without further arguments
        // may be called as one that takes them.
        let handle = unsafe {
            match self.fmi {
                Fmi::Two => {
                    let place = CString::new(format!("file://{path}")).unwrap();
                    let logger: Logger2 = std::mem::transmute(log2 as *const ());
                    let callbacks = Callbacks {
                        logger: Some(logger),
                        allocate_memory: None,
                        free_memory: None,
                        step_finished: None,
                        environment,
                    };
                    let (name, token) = (name.as_ptr(), token.as_ptr());
                    fmi2::fmi2Instantiate(name, 1, token, place.as_ptr(), &callbacks, 0, 1)
                }
                Fmi::Three => {
                    let place = CString::new(format!("{path}/")).unwrap();
                    let (name, token, place) = (name.as_ptr(), token.as_ptr(), place.as_ptr());
                    let log: Logger3 = log3;
                    fmi3::fmi3InstantiateCoSimulation(
                        name,
                        token,
                        place,
                        0,
                        1,
                        0,
                        0,
                        null(),
                        0,
                        environment,
                        Some(log),
                        None,
                    )
                }
            }
        };
        Host { handle, messages, of: self }
    }
}

pub struct Host<'u> {
    pub handle: *mut c_void,
    pub messages: Box<Messages>,
    pub of: &'u Unpacked,
}

/// Calls the function of the host's version.
macro_rules! both {
    ($host:expr, $two:ident, $three:ident ($($argument:expr),*)) => {
        // SAFETY: the handle is a number, and what is pointed to lives here.
        unsafe {
            match $host.of.fmi {
                Fmi::Two => fmi2::$two($host.handle, $($argument),*),
                Fmi::Three => fmi3::$three($host.handle, $($argument),*),
            }
        }
    };
}

impl Host<'_> {
    /// The last message.
    pub fn said(&self) -> String {
        self.messages.lock().unwrap().last().cloned().unwrap_or_default()
    }

    pub fn initialize(&self) -> c_int {
        match self.setup(0.0) {
            OK => self.exit_initialization(),
            other => other,
        }
    }

    pub fn setup(&self, start: f64) -> c_int {
        // SAFETY: no pointers.
        unsafe {
            match self.of.fmi {
                Fmi::Two => {
                    let set = fmi2::fmi2SetupExperiment(self.handle, 0, 0.0, start, 0, 0.0);
                    set.max(fmi2::fmi2EnterInitializationMode(self.handle))
                }
                Fmi::Three => fmi3::fmi3EnterInitializationMode(self.handle, 0, 0.0, start, 0, 0.0),
            }
        }
    }

    pub fn exit_initialization(&self) -> c_int {
        both!(self, fmi2ExitInitializationMode, fmi3ExitInitializationMode())
    }

    pub fn reset(&self) -> c_int {
        both!(self, fmi2Reset, fmi3Reset())
    }

    pub fn terminate(&self) -> c_int {
        both!(self, fmi2Terminate, fmi3Terminate())
    }

    pub fn free(&self) {
        both!(self, fmi2FreeInstance, fmi3FreeInstance());
    }

    pub fn set(&self, name: &str, value: f64) -> c_int {
        self.set_by(self.of.reference(name), value)
    }

    pub fn set_by(&self, reference: u32, value: f64) -> c_int {
        // SAFETY: one of each.
        unsafe {
            match self.of.fmi {
                Fmi::Two => fmi2::fmi2SetReal(self.handle, &reference, 1, &value),
                Fmi::Three => fmi3::fmi3SetFloat64(self.handle, &reference, 1, &value, 1),
            }
        }
    }

    pub fn get(&self, name: &str) -> f64 {
        self.get_all(&[self.of.reference(name)]).unwrap()[0]
    }

    pub fn get_all(&self, references: &[u32]) -> Result<Vec<f64>, c_int> {
        let count = references.len();
        let mut values = vec![0.0; count];
        let (of, to) = (references.as_ptr(), values.as_mut_ptr());
        // SAFETY: as many of each.
        let status = unsafe {
            match self.of.fmi {
                Fmi::Two => fmi2::fmi2GetReal(self.handle, of, count, to),
                Fmi::Three => fmi3::fmi3GetFloat64(self.handle, of, count, to, count),
            }
        };
        if status == OK { Ok(values) } else { Err(status) }
    }

    /// All variables there are.
    pub fn everything(&self) -> Vec<u64> {
        let all: Vec<u32> = (0..self.of.description.variables.len() as u32).collect();
        self.get_all(&all).unwrap().into_iter().map(f64::to_bits).collect()
    }

    pub fn step(&self, point: f64, size: f64) -> c_int {
        let (mut flags, mut last) = ([7_u8; 3], f64::NAN);
        // SAFETY: places for what is written.
        unsafe {
            match self.of.fmi {
                Fmi::Two => fmi2::fmi2DoStep(self.handle, point, size, 0),
                Fmi::Three => {
                    let [event, terminate, early] = &mut flags;
                    let status = fmi3::fmi3DoStep(
                        self.handle,
                        point,
                        size,
                        0,
                        event,
                        terminate,
                        early,
                        &mut last,
                    );
                    assert_eq!(flags, [0; 3]);
                    assert_eq!(last, self.get("time"));
                    status
                }
            }
        }
    }

    /// So many communication steps from 0, times added up as importers do.
    pub fn run(&self, from: usize, to: usize, size: f64) {
        let mut time = 0.0;
        for step in 0..to {
            if step >= from {
                assert_eq!(self.step(time, size), OK, "{}", self.said());
            }
            time += size;
        }
    }

    /// The derivatives of variables along a change of others, both by their references.
    pub fn derivative(&self, of: &[u32], by: &[u32], seed: &[f64]) -> Result<Vec<f64>, c_int> {
        let mut found = vec![0.0; of.len()];
        let (handle, to) = (self.handle, found.as_mut_ptr());
        let (of_at, by_at, seed_at) = (of.as_ptr(), by.as_ptr(), seed.as_ptr());
        // SAFETY: as many of each.
        let status = unsafe {
            match self.of.fmi {
                Fmi::Two => fmi2::fmi2GetDirectionalDerivative(
                    handle,
                    of_at,
                    of.len(),
                    by_at,
                    by.len(),
                    seed_at,
                    to,
                ),
                Fmi::Three => fmi3::fmi3GetDirectionalDerivative(
                    handle,
                    of_at,
                    of.len(),
                    by_at,
                    by.len(),
                    seed_at,
                    seed.len(),
                    to,
                    of.len(),
                ),
            }
        };
        if status == OK { Ok(found) } else { Err(status) }
    }

    pub fn keep(&self) -> Result<*mut c_void, c_int> {
        let mut state = null_mut();
        let status = both!(self, fmi2GetFMUstate, fmi3GetFMUState(&mut state));
        if status == OK { Ok(state) } else { Err(status) }
    }

    pub fn go_back(&self, state: *mut c_void) -> c_int {
        both!(self, fmi2SetFMUstate, fmi3SetFMUState(state))
    }

    pub fn drop_state(&self, state: *mut c_void) -> c_int {
        let mut state = state;
        let status = both!(self, fmi2FreeFMUstate, fmi3FreeFMUState(&mut state));
        assert!(status == ERROR || state.is_null());
        status
    }

    pub fn bytes(&self, state: *mut c_void) -> Vec<u8> {
        let mut size = 0;
        let sized =
            both!(self, fmi2SerializedFMUstateSize, fmi3SerializedFMUStateSize(state, &mut size));
        assert_eq!(sized, OK);
        let mut bytes = vec![0; size];
        let to = bytes.as_mut_ptr();
        assert_eq!(both!(self, fmi2SerializeFMUstate, fmi3SerializeFMUState(state, to, size)), OK);
        bytes
    }

    pub fn take(&self, bytes: &[u8]) -> Result<*mut c_void, c_int> {
        let (mut state, from, size) = (null_mut(), bytes.as_ptr(), bytes.len());
        let status =
            both!(self, fmi2DeSerializeFMUstate, fmi3DeserializeFMUState(from, size, &mut state));
        if status == OK { Ok(state) } else { Err(status) }
    }
}
