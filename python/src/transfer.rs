//! From images to points.

use hidden_point_removal::{Image, Pixels, Transfer, TransferOptions, Values, Weights};
use numpy::{IntoPyArray, PyArrayMethods, PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyIterator};

use crate::answers::{option, refused, warn_if_inverted};
use crate::arguments;
use crate::cloud::{PointCloud, check_listener, views};
use crate::shared::worked;

/// An image: (height, width, channels).
#[derive(FromPyObject)]
enum Picture<'py> {
    Bytes(PyReadonlyArray3<'py, u8>),
    Singles(PyReadonlyArray3<'py, f32>),
    Doubles(PyReadonlyArray3<'py, f64>),
}

impl Picture<'_> {
    fn image(&self) -> Image<'_> {
        let (pixels, channels) = match self {
            Self::Bytes(array) => (
                Pixels::Bytes(array.as_slice().unwrap_or(&[])),
                array.shape()[2],
            ),
            Self::Singles(array) => (
                Pixels::Singles(array.as_slice().unwrap_or(&[])),
                array.shape()[2],
            ),
            Self::Doubles(array) => (
                Pixels::Doubles(array.as_slice().unwrap_or(&[])),
                array.shape()[2],
            ),
        };
        Image { pixels, channels }
    }
}

#[pymethods]
impl PointCloud {
    /// The values of `hidden_point_removal.transfer`, which numbers the words. An image is taken when its camera was asked.
    #[pyo3(signature = (cameras, images, how, on_progress=None, **options))]
    fn _transfer<'py>(
        &self,
        py: Python<'py>,
        cameras: &Bound<'_, PyAny>,
        images: &Bound<'py, PyIterator>,
        how: [usize; 3],
        on_progress: Option<&Bound<'_, PyAny>>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        check_listener(py, on_progress)?;
        let cameras = arguments::cameras(cameras)?;
        let mut asked = self.read(py, options)?;
        let how = TransferOptions::of(how[0], how[1], how[2]);
        asked.options.scores = how.weights == Weights::Score;
        let length = self.__len__(py)?;
        let mut transfer = Transfer::new(length, &how).map_err(|error| refused(py, error))?;
        let mut images = images.clone();
        let mut done = 0;
        let before = self.changes();
        for group in cameras.chunks(asked.options.threads) {
            let seen = self.ask(py, asked.how.clone(), |cloud| {
                views(cloud, group, &asked.options)
            })?;
            for (camera, view) in group.iter().zip(seen) {
                warn_if_inverted(py, view.seems_inverted)?;
                let image = images
                    .next()
                    .ok_or_else(|| count(py, cameras.len(), done))??;
                let picture: Picture<'_> = image.extract()?;
                let image = picture.image();
                worked(py, view.depths.len(), || {
                    transfer.add(camera, &view, &image)
                })?;
                done += 1;
            }
            if let Some(listener) = on_progress {
                self.tell(listener, [done, cameras.len()], before)?;
            }
        }
        if images.next().is_some() {
            return Err(count(py, cameras.len(), done + 1));
        }
        let made = worked(py, length, || transfer.finish())?;
        let shape = [length, made.channels];
        let values = match made.values {
            Values::Singles(values) => values.into_pyarray(py).reshape(shape)?.into_any(),
            Values::Doubles(values) => values.into_pyarray(py).reshape(shape)?.into_any(),
        };
        Ok((values, made.seen.into_pyarray(py).into_any()))
    }
}

fn count(py: Python<'_>, cameras: usize, images: usize) -> PyErr {
    let message = format!("images must hold one image for each of {cameras} cameras, got {images}");
    option(py, message)
}
