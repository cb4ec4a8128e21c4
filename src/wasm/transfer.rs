//! Copies typed arrays into the memory of the wasm and out of it, without a trap where memory
//! is refused.

use alloc::vec::Vec;

use js_sys::{Float32Array, Float64Array, Uint8Array, Uint32Array};
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;

use crate::Error;
#[cfg(feature = "wasm")]
use crate::Pixels;
use crate::base::allocation::filled;
use crate::cloud::points::Points;

#[wasm_bindgen]
extern "C" {
    /// Three numbers for each point, in the precision in which they were given.
    #[wasm_bindgen(typescript_type = "Float32Array | Float64Array")]
    pub type Coordinates;
    #[wasm_bindgen(method, getter, js_name = BYTES_PER_ELEMENT)]
    pub(super) fn bytes_of_each(this: &Coordinates) -> u32;

    /// The numbers of an image.
    #[cfg(feature = "wasm")]
    #[wasm_bindgen(typescript_type = "Uint8Array | Float32Array | Float64Array")]
    pub type Numbers;
    #[cfg(feature = "wasm")]
    #[wasm_bindgen(method, getter, js_name = BYTES_PER_ELEMENT)]
    fn bytes_of_each(this: &Numbers) -> u32;

    /// Memory outside of the wasm, which may be refused.
    #[wasm_bindgen(js_name = ArrayBuffer)]
    type Room;
    #[wasm_bindgen(constructor, catch, js_class = "ArrayBuffer")]
    fn new(length: f64) -> Result<Room, JsValue>;
}

#[inline(never)]
pub(super) fn points(positions: &Coordinates) -> Result<Points, Error> {
    if positions.bytes_of_each() == 8 {
        return Ok(Points::Double(triples(positions.unchecked_ref())?));
    }
    let positions: &Float32Array = positions.unchecked_ref();
    let mut own = zeros::<[f32; 3]>(positions.length() / 3)?;
    positions.copy_to(own.as_flattened_mut());
    Ok(Points::Single(own))
}

/// Points of three doubles each.
#[inline(never)]
pub(super) fn triples(positions: &Float64Array) -> Result<Vec<[f64; 3]>, Error> {
    let mut own = zeros::<[f64; 3]>(positions.length() / 3)?;
    positions.copy_to(own.as_flattened_mut());
    Ok(own)
}

#[cfg(feature = "wasm")]
#[inline(never)]
pub(super) fn numbers(numbers: &Float64Array) -> Result<Vec<f64>, Error> {
    let mut own = zeros(numbers.length())?;
    numbers.copy_to(&mut own);
    Ok(own)
}

#[cfg(feature = "wasm")]
pub(super) fn singles(numbers: &Float32Array) -> Result<Vec<f32>, Error> {
    let mut own = zeros(numbers.length())?;
    numbers.copy_to(&mut own);
    Ok(own)
}

#[cfg(feature = "wasm")]
pub(super) fn groups<const N: usize>(numbers: &Float32Array) -> Result<Vec<[f32; N]>, Error> {
    let mut own = filled(numbers.length() as usize / N, [0.0; N])?;
    numbers.copy_to(own.as_flattened_mut());
    Ok(own)
}

#[cfg(feature = "wasm")]
impl Numbers {
    /// Copies them in, and gives them to `act`.
    pub(super) fn with<T>(&self, act: impl FnOnce(Pixels) -> Result<T, Error>) -> Result<T, Error> {
        match self.bytes_of_each() {
            1 => act(Pixels::Bytes(&copy_in_bytes(self.unchecked_ref())?)),
            4 => act(Pixels::Singles(&singles(self.unchecked_ref())?)),
            _ => act(Pixels::Doubles(&numbers(self.unchecked_ref())?)),
        }
    }
}

#[inline(never)]
pub(super) fn copy_in_integers(integers: &Uint32Array) -> Result<Vec<u32>, Error> {
    let mut own = zeros(integers.length())?;
    integers.copy_to(&mut own);
    Ok(own)
}

#[inline(never)]
pub(super) fn copy_in_bytes(bytes: &Uint8Array) -> Result<Vec<u8>, Error> {
    let mut own = zeros(bytes.length())?;
    bytes.copy_to(&mut own);
    Ok(own)
}

/// Triangles of three indices each.
#[cfg(feature = "wasm")]
#[inline(never)]
pub(super) fn corners(triangles: &Uint32Array) -> Result<Vec<[u32; 3]>, Error> {
    let mut own = zeros::<[u32; 3]>(triangles.length() / 3)?;
    triangles.copy_to(own.as_flattened_mut());
    Ok(own)
}

fn zeros<T: Copy + Default>(count: u32) -> Result<Vec<T>, Error> {
    let zeros = filled(count as usize, T::default())?;
    Ok(zeros)
}

/// Copies for the caller: a view of the wasm's memory dies when that memory grows.
pub(super) fn copy_out(indices: &[u32]) -> Result<Uint32Array, Error> {
    let copy = Uint32Array::new(&room(size_of_val(indices))?);
    copy.copy_from(indices);
    Ok(copy)
}

pub(super) fn copy_out_singles(numbers: &[f32]) -> Result<Float32Array, Error> {
    let copy = Float32Array::new(&room(size_of_val(numbers))?);
    copy.copy_from(numbers);
    Ok(copy)
}

#[cfg(feature = "wasm")]
pub(super) fn copy_out_doubles(numbers: &[f64]) -> Result<Float64Array, Error> {
    let copy = Float64Array::new(&room(size_of_val(numbers))?);
    copy.copy_from(numbers);
    Ok(copy)
}

fn room(bytes: usize) -> Result<JsValue, Error> {
    let room = Room::new(bytes as f64).map_err(|_| Error::OutOfMemory)?;
    Ok(room.into())
}
