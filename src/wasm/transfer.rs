//! Typed arrays into the memory of the wasm and out of it, with no trap where memory
//! is refused.

use alloc::vec::Vec;

use js_sys::{Float32Array, Float64Array, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::Error;
use crate::points::Points;

/// Coordinates copied from JavaScript at a time, where they are not packed.
const BLOCK_POINTS: usize = 4096;

#[wasm_bindgen]
extern "C" {
    // js-sys has this constructor too, but there a refused allocation would
    // unwind through the frames of this instance instead of being an error.
    #[wasm_bindgen(js_name = Uint32Array)]
    type FallibleUint32Array;
    #[wasm_bindgen(catch, constructor, js_class = "Uint32Array")]
    fn new(length: u32) -> Result<FallibleUint32Array, JsValue>;
}

/// The first three of every `stride` values, the length being a multiple of it.
pub(super) fn singles(positions: &Float32Array, stride: u32) -> Result<Points, Error> {
    let copy_block = |start, block: &mut [f32]| {
        positions
            .subarray(start, start + block.len() as u32)
            .copy_to(block);
    };
    copy_in(positions.length(), stride, copy_block).map(Points::Single)
}

/// The first three of every `stride` values, the length being a multiple of it.
pub(super) fn doubles(positions: &Float64Array, stride: u32) -> Result<Points, Error> {
    let copy_block = |start, block: &mut [f64]| {
        positions
            .subarray(start, start + block.len() as u32)
            .copy_to(block);
    };
    copy_in(positions.length(), stride, copy_block).map(Points::Double)
}

fn copy_in<T: Copy + Default>(
    length: u32,
    stride: u32,
    copy_block: impl Fn(u32, &mut [T]),
) -> Result<Vec<[T; 3]>, Error> {
    let (length, stride) = (length as usize, stride as usize);
    let count = length / stride;
    let mut positions: Vec<[T; 3]> = Vec::new();
    positions.try_reserve_exact(count)?;
    if stride == 3 {
        positions.resize(count, [T::default(); 3]);
        copy_block(0, positions.as_flattened_mut());
        return Ok(positions);
    }
    let mut block = Vec::new();
    block.try_reserve_exact(count.min(BLOCK_POINTS).saturating_mul(stride))?;
    for start in (0..count).step_by(BLOCK_POINTS) {
        let points = BLOCK_POINTS.min(count - start);
        block.resize(points * stride, T::default());
        copy_block((start * stride) as u32, &mut block);
        positions.extend(block.chunks_exact(stride).map(|p| [p[0], p[1], p[2]]));
    }
    Ok(positions)
}

pub(super) fn copy_in_integers(integers: &Uint32Array) -> Result<Vec<u32>, Error> {
    let mut own = Vec::new();
    let count = integers.length() as usize;
    own.try_reserve_exact(count)?;
    own.resize(count, 0);
    integers.copy_to(&mut own);
    Ok(own)
}

/// The caller's own copy: views of this memory would die when it grows.
pub(super) fn copy_out(indices: &[u32]) -> Result<Uint32Array, Error> {
    let copy = FallibleUint32Array::new(indices.len() as u32).map_err(|_| Error::OutOfMemory)?;
    let copy: Uint32Array = copy.unchecked_into();
    copy.copy_from(indices);
    Ok(copy)
}
