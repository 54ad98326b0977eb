//! Macros for functions called from C: exported by name, returning a status.
//!
//! `fn name(arguments) |held| work` becomes `extern "C" fn name(handle, arguments) -> status`.

/// Functions that work on a component.
macro_rules! exported {
    ($($(#[$meta:meta])* fn $name:ident($($argument:ident: $type:ty),* $(,)?) $work:expr;)*) => {$(
        #[doc = concat!("`", stringify!($name), "` of the standard. Returns a status; the reason is in the log.")]
        $(#[$meta])*
        ///
        /// # Safety
        /// Pointers are null or as required by the standard.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(handle: *mut c_void, $($argument: $type),*) -> c_int {
            #[allow(unused_unsafe, reason = "some read no pointer")]
            // SAFETY: the pointers are as the caller promises.
            $crate::calls::call(handle, stringify!($name), unsafe { $work })
        }
    )*};
}

/// Functions that this FMU does not support.
macro_rules! unsupported {
    ($(fn $name:ident($($argument:ident: $type:ty),* $(,)?);)*) => {$(
        #[doc = concat!("`", stringify!($name), "` of the standard. Returns an error: not supported by this FMU.")]
        ///
        /// # Safety
        /// None: the pointers are not used.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(handle: *mut c_void, $($argument: $type),*) -> c_int {
            $(let _ = $argument;)*
            $crate::calls::call(handle, stringify!($name), |_| {
                Err($crate::component::Refusal::error("not supported by this FMU"))
            })
        }
    )*};
}

pub(crate) use {exported, unsupported};
