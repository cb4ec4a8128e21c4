//! The Python module `hidden_point_removal._native`. The package of the same name words the public API.

#[macro_use]
mod help;

mod arrays;
mod camera;
mod cloud;
mod failure;
mod horizon;
mod map;
mod options;
mod parts;
mod seen_by;
mod shared;
mod surfaces;
mod surveys;
mod views;
mod visibility;

use pyo3::prelude::*;

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("HprError", module.py().get_type::<failure::HprError>())?;
    module.add_class::<cloud::PointCloud>()?;
    module.add_class::<horizon::Horizon>()?;
    module.add_class::<map::VisibilityMap>()?;
    module.add_function(wrap_pyfunction!(parts::merge_visible, module)?)?;
    module.add_function(wrap_pyfunction!(camera::lenses, module)?)?;
    Ok(())
}
