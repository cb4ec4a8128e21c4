//! A value that is made when it is asked for first.

/// Keeps the value with `std`. Without `std`, it is made for each question.
pub(crate) struct Once<T> {
    #[cfg(feature = "std")]
    kept: std::sync::OnceLock<T>,
    #[cfg(not(feature = "std"))]
    kept: core::marker::PhantomData<T>,
}

impl<T> Default for Once<T> {
    fn default() -> Self {
        Self {
            kept: Default::default(),
        }
    }
}

impl<T: Clone> Once<T> {
    pub(crate) fn get<E>(&self, make: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
        #[cfg(feature = "std")]
        if let Some(kept) = self.kept.get() {
            return Ok(kept.clone());
        }
        let made = make()?;
        #[cfg(feature = "std")]
        let made = self.kept.get_or_init(|| made).clone();
        Ok(made)
    }
}
