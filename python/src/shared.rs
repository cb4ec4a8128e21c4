//! An object that several Python threads use at once: readers share it, a writer waits for them.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, PoisonError, RwLock};
use std::thread;
use std::time::Duration;

use hidden_point_removal::{Error, Stopped, stop_by};
use pyo3::prelude::*;

use crate::answers::refused;

/// Work on fewer points is done in a few milliseconds.
const LONG: usize = 20_000;
/// So often is asked whether the user wants to end the work.
const ASKED_EVERY: Duration = Duration::from_millis(100);

/// The interpreter is released before a thread waits for the lock. So the thread that holds the
/// lock can finish, even if it needs the interpreter.
pub struct Shared<T>(RwLock<T>);

impl<T: Send + Sync> Shared<T> {
    pub fn new(value: T) -> Self {
        Self(RwLock::new(value))
    }

    /// Asks about so many points, beside other readers.
    pub fn ask<A: Send>(
        &self,
        py: Python<'_>,
        points: usize,
        query: impl Send + FnOnce(&T) -> Result<A, Error>,
    ) -> PyResult<A> {
        // A change that panics leaves the value as it was: changes are built beside it.
        worked(py, points, || {
            query(&self.0.read().unwrap_or_else(PoisonError::into_inner))
        })
    }

    /// Changes so many points, alone.
    pub fn change(
        &self,
        py: Python<'_>,
        points: usize,
        change: impl Send + FnOnce(&mut T) -> Result<(), Error>,
    ) -> PyResult<()> {
        worked(py, points, || {
            change(&mut self.0.write().unwrap_or_else(PoisonError::into_inner))
        })
    }

    /// A number of the value.
    pub fn get<A: Send>(&self, py: Python<'_>, get: impl Send + FnOnce(&T) -> A) -> PyResult<A> {
        self.ask(py, 0, |value| Ok(get(value)))
    }
}

/// Works on so many points while other Python threads run. Ctrl-C ends the work of the main thread, which alone is told
/// of it.
pub fn worked<A: Send>(
    py: Python<'_>,
    points: usize,
    work: impl Send + FnOnce() -> Result<A, Error>,
) -> PyResult<A> {
    let done = if points >= LONG && is_main_thread(py)? {
        py.detach(|| watched(work))?
    } else {
        py.detach(work)
    };
    done.map_err(|error| refused(py, error))
}

fn is_main_thread(py: Python<'_>) -> PyResult<bool> {
    let threading = py.import("threading")?;
    let main = threading.call_method0("main_thread")?;
    Ok(main.is(&threading.call_method0("current_thread")?))
}

/// Works in another thread, so that this one can ask whether a signal has come.
fn watched<A: Send>(work: impl Send + FnOnce() -> A) -> PyResult<A> {
    let stop = Arc::new(AtomicBool::new(false));
    thread::scope(|scope| {
        let (sender, done) = channel::<()>();
        let flag = Arc::clone(&stop);
        let worker = scope.spawn(move || {
            // It is dropped when the work ends, also by a panic.
            let _sender = sender;
            stop_by(Some(flag));
            work()
        });
        while done.recv_timeout(ASKED_EVERY) == Err(RecvTimeoutError::Timeout) {
            if let Err(signal) = Python::attach(|py| py.check_signals()) {
                stop.store(true, Ordering::Relaxed);
                return match worker.join() {
                    Err(fault) if !fault.is::<Stopped>() => resume_unwind(fault),
                    _ => Err(signal),
                };
            }
        }
        worker.join().map_or_else(|fault| resume_unwind(fault), Ok)
    })
}
