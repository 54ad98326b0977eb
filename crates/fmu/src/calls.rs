//! Components by importer handle, and the common part of each call.
//!
//! `(handle, work) => status, messages`. A handle is a number that is issued once, so that invalid and freed handles
//! are detected and callers get no internal pointers. Panics are caught here.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ffi::{CString, c_int, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError, RwLock};

use crate::component::{Component, Refusal};
use crate::foreign::{Log, c_text};
use crate::xml::{CATEGORIES, Fmi};

/// `fmi2OK`, `fmi3OK`.
pub const OK: c_int = 0;
/// Refused, or failed; the instance can be reset.
pub const ERROR: c_int = 3;
/// An internal error; the instance is no longer usable.
pub const FATAL: c_int = 4;

/// A component with the data of its handle.
pub struct Held {
    /// The component.
    pub component: Component,
    /// Saved states by handle.
    pub states: BTreeMap<usize, Vec<u8>>,
    /// The status of the last step, with its message.
    pub last_step: (c_int, CString),
    is_broken: bool,
}

struct Entry {
    held: Mutex<Held>,
    log: Log,
}

static ENTRIES: RwLock<BTreeMap<usize, Arc<Entry>>> = RwLock::new(BTreeMap::new());
static NEXT: AtomicUsize = AtomicUsize::new(1);

/// A unique number; never null.
#[must_use]
pub fn new_handle() -> usize {
    // Spaced like allocations.
    NEXT.fetch_add(1, Ordering::Relaxed).wrapping_mul(16)
}

/// A handle as a C pointer.
#[must_use]
pub fn pointer(handle: usize) -> *mut c_void {
    std::ptr::without_provenance_mut(handle)
}

/// The message of a panic.
fn words(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    format!("internal error of the library: {}", text.unwrap_or_default())
}

fn show(log: &Log, status: c_int, function: &str, message: &str) {
    let [(errors, _)] = CATEGORIES;
    log.write(status, errors, &format!("{function}: {message}"));
}

/// Makes a component and returns its handle; null with a message if refused.
pub fn instantiate(
    function: &str,
    log: Log,
    fmi: Fmi,
    find: impl FnOnce() -> Result<(PathBuf, String), String>,
) -> *mut c_void {
    let made = catch_unwind(AssertUnwindSafe(|| {
        let (folder, token) = find()?;
        Component::new(&folder, fmi, &token)
    }));
    match made {
        Ok(Ok(component)) => {
            let last_step = (OK, CString::default());
            let held = Held { component, states: BTreeMap::new(), last_step, is_broken: false };
            let (handle, held) = (new_handle(), Mutex::new(held));
            let entry = Arc::new(Entry { held, log });
            ENTRIES.write().unwrap_or_else(PoisonError::into_inner).insert(handle, entry);
            pointer(handle)
        }
        Ok(Err(message)) => {
            show(&log, ERROR, function, &message);
            std::ptr::null_mut()
        }
        Err(panic) => {
            show(&log, FATAL, function, &words(&*panic));
            std::ptr::null_mut()
        }
    }
}

/// Frees a component; an invalid handle is ignored.
pub fn free(handle: *mut c_void) {
    let mut entries = ENTRIES.write().unwrap_or_else(PoisonError::into_inner);
    let freed = entries.remove(&handle.addr());
    drop(entries);
    drop(freed);
}

/// Runs work on a component; returns the status, and logs a message if it is not OK.
pub fn call(
    handle: *mut c_void,
    function: &str,
    work: impl FnOnce(&mut Held) -> Result<(), Refusal>,
) -> c_int {
    let entries = ENTRIES.read().unwrap_or_else(PoisonError::into_inner);
    let entry = entries.get(&handle.addr()).cloned();
    drop(entries);
    let Some(entry) = entry else { return ERROR };
    let mut held = entry.held.lock().unwrap_or_else(PoisonError::into_inner);
    let (status, message) = if held.is_broken {
        (FATAL, "the instance has failed; free it".to_owned())
    } else {
        match catch_unwind(AssertUnwindSafe(|| work(&mut held))) {
            Ok(Ok(())) => return OK,
            Ok(Err(Refusal::Error(message))) => (ERROR, message),
            Err(panic) => {
                held.is_broken = true;
                (FATAL, words(&*panic))
            }
        }
    };
    // The logger may call back.
    drop(held);
    show(&entry.log, status, function, &message);
    status
}

/// Checks names of categories. Errors are always shown.
pub(crate) fn check_categories<'c>(
    names: impl Iterator<Item = Option<Cow<'c, str>>>,
) -> Result<(), Refusal> {
    for name in names {
        let name = name.ok_or_else(|| Refusal::error("null pointer as a category"))?;
        if !CATEGORIES.iter().any(|(known, _)| *known == name) {
            return Err(Refusal::Error(format!("unknown category {name}")));
        }
    }
    Ok(())
}

impl Held {
    /// Saves the present state; returns its handle.
    ///
    /// # Errors
    /// If the plant has failed.
    pub fn keep(&mut self, asked: usize) -> Result<usize, Refusal> {
        let state = self.component.save()?;
        Ok(self.put(asked, state))
    }

    /// Stores bytes as a state, replacing that of a handle if given.
    fn put(&mut self, asked: usize, state: Vec<u8>) -> usize {
        let handle = if self.states.contains_key(&asked) { asked } else { new_handle() };
        self.states.insert(handle, state);
        handle
    }

    /// Stores a caller's bytes as a state.
    ///
    /// # Errors
    /// If they are not a state of this FMU.
    pub fn take(&mut self, bytes: &[u8]) -> Result<usize, Refusal> {
        self.component.check(bytes)?;
        Ok(self.put(0, bytes.to_vec()))
    }

    /// A saved state.
    ///
    /// # Errors
    /// A handle that does not belong to this instance.
    pub fn state(&self, handle: usize) -> Result<&[u8], Refusal> {
        let state = self.states.get(&handle).map(Vec::as_slice);
        state.ok_or_else(|| Refusal::error("unknown state: the instance has not saved it"))
    }

    /// Restores a saved state.
    ///
    /// # Errors
    /// A handle that does not belong to this instance, or a damaged state.
    pub fn go_back(&mut self, handle: usize) -> Result<(), Refusal> {
        let state = self.states.get(&handle);
        let state =
            state.ok_or_else(|| Refusal::error("unknown state: the instance has not saved it"))?;
        self.component.restore(state)
    }

    /// A communication step, whose status is stored.
    ///
    /// # Errors
    /// As [`Component::step`].
    pub fn step(&mut self, point: f64, size: f64) -> Result<(), Refusal> {
        let done = self.component.step(point, size);
        self.last_step = match &done {
            Ok(()) => (OK, CString::default()),
            Err(Refusal::Error(text)) => (ERROR, c_text(text)),
        };
        done
    }
}
