//! The operator: a view from one viewpoint, and its radius.

use wasm_bindgen::prelude::*;

use crate::Sector;
use crate::base::build::FULL;
use crate::hull::Memory;
use crate::view::refusals::QuestionKind;
use crate::wasm::answer::{answered, chosen};
use crate::wasm::clouds::{with_cloud, with_memory};
use crate::wasm::options::ViewOptions;

/// Which points are visible from (x, y, z)?
#[wasm_bindgen(js_name = visibleFrom, unchecked_return_type = "Answer")]
pub fn visible_from(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    if FULL {
        return seen(handle, [x, y, z], options, Sector::WHOLE);
    }
    let view = options.read();
    // The operator alone has no draft to go on from. New room takes at most 2 % longer.
    let seen = with_cloud(handle, |cloud| {
        view.check(QuestionKind::View)?;
        cloud.seen_by_hull(1, &mut Memory::new(), [x, y, z], &view)
    });
    answered(seen, options)
}

/// A view, or a sector of it.
pub(super) fn seen(
    handle: u32,
    viewpoint: [f64; 3],
    options: &ViewOptions,
    sector: Sector,
) -> Result<JsValue, JsValue> {
    let view = options.read();
    let seen = with_memory(handle, viewpoint, options, &view, |cloud, memory| {
        cloud.visible_in_sector_with(memory, viewpoint, &view, sector)
    });
    answered(seen, options)
}

/// The radius that the rule of `options` chooses for (x, y, z).
#[wasm_bindgen(js_name = autoRadius, unchecked_return_type = "ChosenRadius")]
pub fn auto_radius(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    let rule = options.read().radius;
    chosen(with_cloud(handle, |cloud| {
        cloud.auto_radius([x, y, z], rule)
    }))
}
