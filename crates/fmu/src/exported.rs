//! The shape of a function that C calls: exported by its name, a status as result.
//!
//! `fn name(arguments) |held| work` becomes `extern "C" fn name(handle, arguments) -> status`.

/// Functions that work on a component.
macro_rules! exported {
    ($($(#[$meta:meta])* fn $name:ident($($argument:ident: $type:ty),* $(,)?) $work:expr;)*) => {$(
        #[doc = concat!("`", stringify!($name), "` of the standard: a status; what is wrong is in the log.")]
        $(#[$meta])*
        ///
        /// # Safety
        /// Pointers are null or as the standard has them.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(handle: *mut c_void, $($argument: $type),*) -> c_int {
            #[allow(unused_unsafe, reason = "some read no pointer")]
            // SAFETY: what is called goes by the pointers as the caller promises them.
            $crate::calls::call(handle, stringify!($name), unsafe { $work })
        }
    )*};
}

/// Functions of what this FMU does not have.
macro_rules! unsupported {
    ($(fn $name:ident($($argument:ident: $type:ty),* $(,)?);)*) => {$(
        #[doc = concat!("`", stringify!($name), "` of the standard: an error, for this FMU has no such thing.")]
        ///
        /// # Safety
        /// None: the pointers are not looked at.
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
