//! Options of a view. JavaScript has checked their types; the crate checks their ranges.

use js_sys::{Float64Array, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::base::build::FULL;
use crate::{Exponential, Inversion, Options, Radius, Within};

#[wasm_bindgen]
extern "C" {
    /// Without serde: its messages about wrong types bring the formatting of floats, 30 kB.
    #[wasm_bindgen(typescript_type = "ViewOptions")]
    pub type ViewOptions;
    /// Numbers stand for the choices (`coreOptions` in src/ts/query/view-options.ts).
    #[wasm_bindgen(method, getter)]
    fn numbers(this: &ViewOptions) -> Float64Array;
    #[wasm_bindgen(method, getter)]
    pub(super) fn mask(this: &ViewOptions) -> Option<Uint8Array>;
    /// JavaScript makes the arrays of an answer: a refused allocation there is an error rather than a trap.
    #[wasm_bindgen(method, catch)]
    pub(super) fn memory(this: &ViewOptions, length: u32) -> Result<Uint32Array, JsValue>;
}

impl ViewOptions {
    pub(super) fn read(&self) -> Options {
        let mut numbers = [0.0; 13];
        self.numbers().copy_to(&mut numbers);
        let [rule, size, kernel, parameter, others @ ..] = numbers;
        let [scores, thickness, distance, bounds @ ..] = others;
        let operator = Options {
            radius: match rule as u32 {
                1 => Radius::Opposite,
                2 => Radius::Absolute(size),
                3 => Radius::Exponent(size),
                _ => Radius::Auto,
            },
            inversion: match kernel as u32 {
                1 => Inversion::Power(parameter),
                2 => Inversion::Exponential(Exponential::Auto),
                3 => Inversion::Exponential(Exponential::Scale(parameter)),
                4 => Inversion::Looks(parameter as usize),
                _ => Inversion::Spherical,
            },
            ..Options::default()
        };
        if !FULL {
            return operator;
        }
        let [a, b, c, d, e, f] = bounds;
        let bounds = [[a, b, c], [d, e, f]];
        let is_bounded = bounds != [[f64::NEG_INFINITY; 3], [f64::INFINITY; 3]];
        let within = Within {
            distance: Some(distance).filter(|distance| *distance != f64::INFINITY),
            bounds: Some(bounds).filter(|_| is_bounded),
        };
        Options {
            scores: scores != 0.0,
            // A negative number stands for none.
            thickness: Some(thickness).filter(|thickness| *thickness >= 0.0),
            within: Some(within).filter(|within| *within != Within::default()),
            ..operator
        }
    }
}
