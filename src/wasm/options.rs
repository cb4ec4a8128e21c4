//! Options of a view. JavaScript has checked their types; the crate checks their ranges.

use js_sys::{Float64Array, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::base::build::FULL;
use crate::{Exponential, Inversion, Options, Radius, Within};

#[wasm_bindgen]
extern "C" {
    /// Read field by field, without serde: its messages about wrong types bring the formatting of
    /// floats, 30 kB. Numbers stand for the choices (src/ts/query/view-options.ts).
    #[wasm_bindgen(typescript_type = "ViewOptions")]
    pub type ViewOptions;
    #[wasm_bindgen(method, getter)]
    fn rule(this: &ViewOptions) -> f64;
    #[wasm_bindgen(method, getter)]
    fn size(this: &ViewOptions) -> f64;
    #[wasm_bindgen(method, getter)]
    fn kernel(this: &ViewOptions) -> f64;
    #[wasm_bindgen(method, getter)]
    fn parameter(this: &ViewOptions) -> f64;
    #[wasm_bindgen(method, getter)]
    fn denoise(this: &ViewOptions) -> f64;
    #[wasm_bindgen(method, getter)]
    fn vote(this: &ViewOptions) -> f64;
    #[wasm_bindgen(method, getter)]
    fn scores(this: &ViewOptions) -> bool;
    #[wasm_bindgen(method, getter)]
    fn thickness(this: &ViewOptions) -> f64;
    #[wasm_bindgen(method, getter)]
    fn draft(this: &ViewOptions) -> bool;
    #[wasm_bindgen(method, getter)]
    fn sample(this: &ViewOptions) -> f64;
    /// The distance and the box of the option `within`, seven numbers. Infinity stands for none.
    #[wasm_bindgen(method, getter)]
    fn within(this: &ViewOptions) -> Option<Float64Array>;
    #[wasm_bindgen(method, getter)]
    pub(super) fn mask(this: &ViewOptions) -> Option<Uint8Array>;
    /// JavaScript makes the arrays of an answer. It can reuse memory, and a refused allocation
    /// there is an error rather than a trap.
    #[wasm_bindgen(method, catch)]
    pub(super) fn memory(this: &ViewOptions, length: u32) -> Result<Uint32Array, JsValue>;
}

impl ViewOptions {
    pub(super) fn read(&self) -> Options {
        // Conversions saturate. 0 stands for no option; JavaScript refuses a 0 of the caller.
        let number = |k: f64| (k > 0.0).then_some(k as usize);
        let operator = Options {
            radius: self.read_radius(),
            inversion: match self.kernel() as u32 {
                1 => Inversion::Power(self.parameter()),
                2 => Inversion::Exponential(Exponential::Auto),
                3 => Inversion::Exponential(Exponential::Scale(self.parameter())),
                4 => Inversion::Looks(self.parameter() as usize),
                _ => Inversion::Spherical,
            },
            ..Options::default()
        };
        if !FULL {
            return operator;
        }
        Options {
            denoise: number(self.denoise()),
            vote: number(self.vote()),
            scores: self.scores(),
            // A negative number stands for none.
            thickness: Some(self.thickness()).filter(|thickness| *thickness >= 0.0),
            draft: self.draft(),
            sample: number(self.sample()),
            within: self.within().map(|given| {
                let mut numbers = [0.0; 7];
                given.copy_to(&mut numbers);
                let [distance, a, b, c, d, e, f] = numbers;
                let bounds = [[a, b, c], [d, e, f]];
                let is_bounded = bounds != [[f64::NEG_INFINITY; 3], [f64::INFINITY; 3]];
                Within {
                    distance: Some(distance).filter(|distance| *distance != f64::INFINITY),
                    bounds: Some(bounds).filter(|_| is_bounded),
                }
            }),
            ..operator
        }
    }

    pub(super) fn read_radius(&self) -> Radius {
        match self.rule() as u32 {
            1 => Radius::Search,
            2 => Radius::Opposite,
            3 => Radius::Absolute(self.size()),
            4 => Radius::Exponent(self.size()),
            _ => Radius::Auto,
        }
    }
}
