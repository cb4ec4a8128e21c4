//! Options of a cloud and of a view. JavaScript has checked their types; the crate checks their ranges.

use alloc::vec::Vec;

use js_sys::{Array, Function, Uint8Array};
use wasm_bindgen::prelude::*;

use crate::base::FULL;
use crate::{Exponential, Given, Inversion, NonFinite, Options, Radius, Within};

// Without serde: its messages about wrong types bring the formatting of floats, 30 kB.
#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(typescript_type = "CloudOptions")]
    pub type CloudOptions;
    #[wasm_bindgen(method, getter, js_name = skipNonFinite)]
    fn skip_non_finite(this: &CloudOptions) -> bool;
    /// A function that is called with the share of the building that is done.
    #[wasm_bindgen(method, getter)]
    pub(super) fn progress(this: &CloudOptions) -> Option<Function>;

    #[wasm_bindgen(typescript_type = "ViewOptions")]
    pub type ViewOptions;
    #[wasm_bindgen(method, getter)]
    fn rule(this: &ViewOptions) -> u32;
    #[wasm_bindgen(method, getter)]
    fn size(this: &ViewOptions) -> f64;
    #[wasm_bindgen(method, getter)]
    fn kernel(this: &ViewOptions) -> u32;
    #[wasm_bindgen(method, getter)]
    fn parameter(this: &ViewOptions) -> f64;
    #[wasm_bindgen(method, getter)]
    fn others(this: &ViewOptions) -> Array;
    #[wasm_bindgen(method, getter)]
    fn within(this: &ViewOptions) -> Vec<f64>;
    #[wasm_bindgen(method, getter)]
    pub(super) fn mask(this: &ViewOptions) -> Option<Uint8Array>;
}

impl CloudOptions {
    pub(super) fn non_finite(&self) -> NonFinite {
        if self.skip_non_finite() {
            NonFinite::Skip
        } else {
            NonFinite::Error
        }
    }
}

impl ViewOptions {
    pub(super) fn read(&self) -> Options {
        let mut options = Options {
            radius: match self.rule() {
                1 => Radius::Opposite,
                2 => Radius::Absolute(self.size()),
                3 => Radius::Exponent(self.size()),
                _ => Radius::Auto,
            },
            inversion: match self.kernel() {
                1 => Inversion::Power(self.parameter()),
                2 => Inversion::Exponential(Exponential::Auto),
                3 => Inversion::Exponential(Exponential::Scale(self.parameter())),
                4 => Inversion::Looks(self.parameter() as usize),
                _ => Inversion::Spherical,
            },
            ..Options::default()
        };
        if FULL {
            options.within = self.read_within();
            for other in self.others().iter() {
                let other = Array::from(&other);
                let (name, value) = (other.get(0).as_string(), other.get(1));
                let word = value.as_string();
                let value = match (value.as_f64(), value.as_bool(), &word) {
                    (Some(number), ..) => Given::Number(number),
                    (_, Some(truth), _) => Given::Truth(truth),
                    _ => Given::Word(word.as_deref().unwrap_or_default()),
                };
                // JavaScript has checked it by its row.
                let _ = options.set(&name.unwrap_or_default(), value);
            }
        }
        options
    }

    fn read_within(&self) -> Option<Within> {
        let [distance, a, b, c, d, e, f] = *self.within().first_chunk()?;
        let bounds = [[a, b, c], [d, e, f]];
        let is_bounded = bounds != [[f64::NEG_INFINITY; 3], [f64::INFINITY; 3]];
        let within = Within {
            distance: Some(distance).filter(|distance| *distance != f64::INFINITY),
            bounds: Some(bounds).filter(|_| is_bounded),
        };
        Some(within).filter(|within| *within != Within::default())
    }
}
