//! The Python module `hidden_point_removal._native`. The package of the same name words the public API.

#[macro_use]
mod options;

mod answers;
mod arguments;
mod cloud;
mod map;
mod merge;
mod shared;
mod surveys;
mod transfer;
mod views;

use pyo3::prelude::*;

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("HprError", module.py().get_type::<answers::HprError>())?;
    module.add_class::<cloud::PointCloud>()?;
    module.add_class::<merge::Horizon>()?;
    module.add_class::<map::VisibilityMap>()?;
    module.add_function(wrap_pyfunction!(merge::merge_visible, module)?)?;
    module.add_function(wrap_pyfunction!(map::of_parts, module)?)?;
    module.add_function(wrap_pyfunction!(surveys::lenses, module)?)?;
    Ok(())
}
