//! Components by the handles that an importer has, and what happens around each call.
//!
//! `(handle, work) => status, messages`. A handle is a number that is given out once, so that one that is none
//! or has been freed is told, and no pointer of ours is a caller's. No panic goes further than here.

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
/// A defect of ours; the instance is of no use any more.
pub const FATAL: c_int = 4;

/// A component, and what belongs to its handle.
pub struct Held {
    /// The component.
    pub component: Component,
    /// States that were kept, by their handles.
    pub states: BTreeMap<usize, Vec<u8>>,
    /// The status of the last step, and what was said of it.
    pub last_step: (c_int, CString),
    is_broken: bool,
}

struct Entry {
    held: Mutex<Held>,
    log: Log,
}

static ENTRIES: RwLock<BTreeMap<usize, Arc<Entry>>> = RwLock::new(BTreeMap::new());
static NEXT: AtomicUsize = AtomicUsize::new(1);

/// A number that no other handle has; never null.
#[must_use]
pub fn new_handle() -> usize {
    // As far from one another as what is allocated.
    NEXT.fetch_add(1, Ordering::Relaxed).wrapping_mul(16)
}

/// A handle as C has it.
#[must_use]
pub fn pointer(handle: usize) -> *mut c_void {
    std::ptr::without_provenance_mut(handle)
}

/// What a panic says.
fn words(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    format!("a defect of the library: {}", text.unwrap_or_default())
}

fn show(log: &Log, status: c_int, function: &str, message: &str) {
    let [(errors, _)] = CATEGORIES;
    log.write(status, errors, &format!("{function}: {message}"));
}

/// Makes a component and gives its handle; null with a message where that is refused.
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

/// Forgets a component; a handle that is none is left alone.
pub fn free(handle: *mut c_void) {
    let mut entries = ENTRIES.write().unwrap_or_else(PoisonError::into_inner);
    let freed = entries.remove(&handle.addr());
    drop(entries);
    drop(freed);
}

/// Works on a component: the status, with a message in the importer's log where it is not OK.
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
        (FATAL, "it has failed for good; free it".to_owned())
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
    // The logger may call us.
    drop(held);
    show(&entry.log, status, function, &message);
    status
}

/// Checks names of categories. Errors are always shown.
pub(crate) fn check_categories<'c>(
    names: impl Iterator<Item = Option<Cow<'c, str>>>,
) -> Result<(), Refusal> {
    for name in names {
        let name = name.ok_or_else(|| Refusal::error("a null pointer as a category"))?;
        if !CATEGORIES.iter().any(|(known, _)| *known == name) {
            return Err(Refusal::Error(format!("there is no category {name}")));
        }
    }
    Ok(())
}

impl Held {
    /// Keeps the present state; its handle.
    ///
    /// # Errors
    /// Where the plant has failed.
    pub fn keep(&mut self, asked: usize) -> Result<usize, Refusal> {
        let state = self.component.save()?;
        Ok(self.put(asked, state))
    }

    /// Keeps bytes as a state, in place of the one of a handle where there is one.
    fn put(&mut self, asked: usize, state: Vec<u8>) -> usize {
        let handle = if self.states.contains_key(&asked) { asked } else { new_handle() };
        self.states.insert(handle, state);
        handle
    }

    /// Keeps a caller's bytes as a state.
    ///
    /// # Errors
    /// Where they are none of this FMU.
    pub fn take(&mut self, bytes: &[u8]) -> Result<usize, Refusal> {
        self.component.check(bytes)?;
        Ok(self.put(0, bytes.to_vec()))
    }

    /// A state that was kept.
    ///
    /// # Errors
    /// A handle that is none of this instance's.
    pub fn state(&self, handle: usize) -> Result<&[u8], Refusal> {
        let state = self.states.get(&handle).map(Vec::as_slice);
        state.ok_or_else(|| Refusal::error("this is no state that the instance keeps"))
    }

    /// Goes back to a state that was kept.
    ///
    /// # Errors
    /// A handle that is none of this instance's, or a damaged state.
    pub fn go_back(&mut self, handle: usize) -> Result<(), Refusal> {
        let state = self.states.get(&handle);
        let state =
            state.ok_or_else(|| Refusal::error("this is no state that the instance keeps"))?;
        self.component.restore(state)
    }

    /// A communication step, whose status is remembered.
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
