//! Numbers of items that are types: those of a law's dampers.

/// A fixed number of items: `[(); 2]` has two.
pub trait Several: 'static {
    /// The number.
    const COUNT: usize;
    /// An array of `T`.
    type Of<T: Copy + Send + Sync + 'static>: Copy + AsRef<[T]> + AsMut<[T]> + Send + Sync + 'static;
    /// An array of equal items.
    fn of<T: Copy + Send + Sync + 'static>(value: T) -> Self::Of<T>;
}

impl<const N: usize> Several for [(); N] {
    const COUNT: usize = N;
    type Of<T: Copy + Send + Sync + 'static> = [T; N];
    #[inline(always)]
    fn of<T: Copy + Send + Sync + 'static>(value: T) -> [T; N] {
        [value; N]
    }
}
