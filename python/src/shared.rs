//! An object that several Python threads use at once: readers share it, a writer waits for them.

use std::sync::{PoisonError, RwLock};

use hidden_point_removal::Error;
use pyo3::prelude::*;

use crate::failure::refused;

/// The interpreter is released before a thread waits for the lock. So the thread that holds the
/// lock can finish, even if it needs the interpreter.
pub struct Shared<T>(RwLock<T>);

impl<T: Send + Sync> Shared<T> {
    pub fn new(value: T) -> Self {
        Self(RwLock::new(value))
    }

    /// Asks, beside other readers.
    pub fn ask<A: Send>(
        &self,
        py: Python<'_>,
        query: impl Send + FnOnce(&T) -> Result<A, Error>,
    ) -> PyResult<A> {
        // A change that panics leaves the value as it was: changes are built beside it.
        py.detach(|| query(&self.0.read().unwrap_or_else(PoisonError::into_inner)))
            .map_err(|error| refused(py, error))
    }

    /// Changes, alone.
    pub fn change(
        &self,
        py: Python<'_>,
        change: impl Send + FnOnce(&mut T) -> Result<(), Error>,
    ) -> PyResult<()> {
        py.detach(|| change(&mut self.0.write().unwrap_or_else(PoisonError::into_inner)))
            .map_err(|error| refused(py, error))
    }

    /// A number of the value.
    pub fn get<A: Send>(&self, py: Python<'_>, get: impl Send + FnOnce(&T) -> A) -> PyResult<A> {
        self.ask(py, |value| Ok(get(value)))
    }
}
