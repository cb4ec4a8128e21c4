//! Meshes, light, the thickness of scans, maps of directions and panoramas. All are computed from views.

use js_sys::{Float32Array, Float64Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::base::allocation::with_capacity;
use crate::wasm::answer::{answer, list, object};
use crate::wasm::clouds::{with_memory, with_view};
use crate::wasm::options::ViewOptions;
use crate::wasm::transfer::{copy_in_integers, copy_out_singles, corners, triples};
use crate::{Lighting, MapOptions, PanoramaOptions, Station};

/// The points that are visible from (x, y, z), and the triangles between them.
#[wasm_bindgen(unchecked_return_type = "Answer")]
pub fn reconstruct(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
    max_edge: Option<f64>,
) -> Result<JsValue, JsValue> {
    let view = options.read();
    let mesh = with_view(handle, Some([x, y, z]), options, &view, |cloud| {
        cloud.reconstruct([x, y, z], &view, max_edge)
    })?;
    Ok(answer(&mesh.visibility, mesh.triangles.as_flattened())?)
}

/// Writes the brightness of every index into `target`, which has the length of the cloud.
/// `lights` holds x, y, z of one light after another.
#[wasm_bindgen]
pub fn illuminate(
    handle: u32,
    lights: &Float64Array,
    options: &ViewOptions,
    triangles: Option<Uint32Array>,
    smoothing: f64,
    ambient: f64,
    target: &Float32Array,
) -> Result<(), JsValue> {
    let view = options.read();
    let brightness = with_view(handle, None, options, &view, |cloud| {
        let lights = triples(lights)?;
        let triangles = triangles.as_ref().map(corners).transpose()?;
        let lighting = Lighting {
            triangles: triangles.as_deref(),
            smoothing: smoothing as usize,
            ambient,
        };
        cloud.illuminate(&lights, &view, &lighting)
    })?;
    target.copy_from(&brightness);
    Ok(())
}

/// The thickness at which scanners see their own points. `viewpoints` holds x, y, z of one station after another, `indices`
/// the points of all, and `ends` where those of each end.
#[wasm_bindgen(unchecked_return_type = "CalibrationAnswer")]
pub fn calibrate(
    handle: u32,
    viewpoints: &Float64Array,
    ends: &Uint32Array,
    indices: &Uint32Array,
    options: &ViewOptions,
) -> Result<JsValue, JsValue> {
    let view = options.read();
    let found = with_view(handle, None, options, &view, |cloud| {
        let (places, ends) = (triples(viewpoints)?, copy_in_integers(ends)?);
        let indices = copy_in_integers(indices)?;
        let mut stations = with_capacity(places.len())?;
        let mut start = 0;
        for (&viewpoint, &end) in places.iter().zip(&ends) {
            let indices = &indices[start..end as usize];
            stations.push(Station { viewpoint, indices });
            start = end as usize;
        }
        cloud.calibrate(&stations, &view)
    })?;
    Ok(object(&[
        ("thickness", &found.thickness.into()),
        ("recall", &list(&found.recall)),
        ("shown", &found.shown.into()),
        ("isLow", &found.is_low().into()),
    ]))
}

/// A map of directions around (x, y, z). `map` holds the number of points, a direction
/// and its angle, and an origin. A number of 0 stands for the default, an angle of 0 stands for all directions, and an origin of infinity
/// for none.
#[wasm_bindgen(js_name = visibilityMap, unchecked_return_type = "MapAnswer")]
pub fn visibility_map(
    handle: u32,
    x: f64,
    y: f64,
    z: f64,
    options: &ViewOptions,
    map: &Float64Array,
) -> Result<JsValue, JsValue> {
    let view = options.read();
    let mut numbers = [0.0; 8];
    map.copy_to(&mut numbers);
    let [points, a, b, c, angle, origin @ ..] = numbers;
    with_memory(handle, [x, y, z], options, &view, |cloud, memory| {
        let choices = MapOptions {
            points: match points {
                0.0 => MapOptions::default().points,
                points => points as usize,
            },
            towards: (angle != 0.0).then_some(([a, b, c], angle)),
            origin: Some(origin).filter(|origin| origin[0] != f64::INFINITY),
        };
        let made = cloud.visibility_map_with(memory, [x, y, z], &view, &choices)?;
        Ok(object(&[
            ("data", &copy_out_singles(made.data())?.into()),
            ("center", &list(&cloud.middle())),
            ("origin", &list(&made.origin())),
            ("numbers", &list(&made.numbers().map(f64::from))),
        ]))
    })
}

/// Writes what stands in each direction into `ranges` and `indices`, which have a place for each pixel, and
/// the sky view factor and the solid angle into `areas`. `asked` holds x, y, z of the viewpoint, the width,
/// the height, and x, y, z of the direction up.
#[wasm_bindgen]
pub fn panorama(
    handle: u32,
    asked: &Float64Array,
    options: &ViewOptions,
    ranges: &Float32Array,
    indices: &Uint32Array,
    areas: &Float64Array,
) -> Result<(), JsValue> {
    let view = options.read();
    let mut numbers = [0.0; 8];
    asked.copy_to(&mut numbers);
    let [x, y, z, width, height, up @ ..] = numbers;
    let choices = PanoramaOptions {
        width: width as usize,
        height: height as usize,
        up,
    };
    let made = with_memory(handle, [x, y, z], options, &view, |cloud, memory| {
        cloud.panorama_with(memory, [x, y, z], &view, &choices)
    })?;
    ranges.copy_from(&made.ranges);
    indices.copy_from(&made.indices);
    areas.copy_from(&[made.sky_view_factor, made.solid_angle]);
    Ok(())
}
