//! What is made of many views, which come one after another: values of images, and a choice of viewpoints.
//! They are kept among the clouds, and freed as clouds are.

use alloc::boxed::Box;
use alloc::vec::Vec;

use js_sys::{Float32Array, Float64Array, Uint32Array};
use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;

use crate::answers::transfer::{Shown, Transfer};
use crate::base::allocation::with_capacity;
use crate::wasm::answer::{list, object};
use crate::wasm::clouds::{Cloud, Placed, change_any, created};
use crate::wasm::transfer::{
    Coordinates, Numbers, copy_in_integers, copy_out, groups, numbers, singles,
};
use crate::wasm::views::read;
use crate::{Choice, Error, Image, Placing, TransferOptions};

#[wasm_bindgen]
extern "C" {
    /// An answer of `visibleFromCamera`.
    #[wasm_bindgen(typescript_type = "ShownPoints")]
    pub type ShownPoints;
    #[wasm_bindgen(method, getter)]
    fn indices(this: &ShownPoints) -> Uint32Array;
    #[wasm_bindgen(method, getter)]
    fn pixels(this: &ShownPoints) -> Float32Array;
    #[wasm_bindgen(method, getter)]
    fn depths(this: &ShownPoints) -> Float32Array;
    #[wasm_bindgen(method, getter)]
    fn towards(this: &ShownPoints) -> Option<Float32Array>;
    #[wasm_bindgen(method, getter)]
    fn scores(this: &ShownPoints) -> Option<Float32Array>;
}

/// Values for a cloud of so many indices. The words are numbers, in the order of the options.
#[wasm_bindgen(js_name = createTransfer, unchecked_return_type = "CloudInfo")]
pub fn create_transfer(
    length: u32,
    merge: u32,
    weights: u32,
    sampling: u32,
) -> Result<JsValue, JsValue> {
    let how = TransferOptions::of(merge as usize, weights as usize, sampling as usize);
    let made = Transfer::new(length as usize, &how);
    created(made.map(|transfer| Cloud::Transfer(Box::new(transfer))))
}

/// Takes the values of what a camera sees.
#[wasm_bindgen(js_name = addImage)]
pub fn add_image(
    handle: u32,
    camera: &Float64Array,
    view: &ShownPoints,
    image: &Numbers,
    channels: u32,
) -> Result<(), JsValue> {
    let (indices, pixels) = (copy_in_integers(&view.indices())?, groups(&view.pixels())?);
    let depths = singles(&view.depths())?;
    let towards = view.towards().as_ref().map(groups).transpose()?;
    let scores = view.scores().as_ref().map(singles).transpose()?;
    let shown = Shown {
        indices: &indices,
        pixels: &pixels,
        depths: &depths,
        towards: towards.as_deref().unwrap_or_default(),
        scores: scores.as_deref().unwrap_or_default(),
    };
    with_transfer(handle, &mut |transfer| {
        image.with(|pixels| {
            let channels = channels as usize;
            transfer.take(&read(camera), &shown, &Image { pixels, channels })
        })
    })
}

/// Writes the merged values of every index into `values`, and how many cameras gave them into `seen`.
#[wasm_bindgen(js_name = writeValues)]
pub fn write_values(handle: u32, values: &Coordinates, seen: &Uint32Array) -> Result<(), JsValue> {
    with_transfer(handle, &mut |transfer| {
        let mut at = 0;
        let mut single: Vec<f32> = Vec::new();
        let is_double = values.bytes_of_each() == 8;
        let counts = transfer.rows(&mut |block| {
            let end = at + block.len() as u32;
            if is_double {
                let target: &Float64Array = values.unchecked_ref();
                target.subarray(at, end).copy_from(block);
            } else {
                single.clear();
                single.extend(block.iter().map(|&value| value as f32));
                let target: &Float32Array = values.unchecked_ref();
                target.subarray(at, end).copy_from(&single);
            }
            at = end;
        })?;
        seen.copy_from(counts);
        Ok(())
    })
}

fn with_transfer(
    handle: u32,
    act: &mut dyn FnMut(&mut Transfer) -> Result<(), Error>,
) -> Result<(), JsValue> {
    change_any(handle, &mut |cloud| match cloud {
        Cloud::Transfer(transfer) => act(transfer),
        _ => Ok(()),
    })?;
    Ok(())
}

/// Views are kept while they take no more memory than this, in bytes; others are asked again.
const MOST_KEPT: usize = 1 << 26;

/// A choice among so many candidates, for a cloud of so many indices.
#[wasm_bindgen(js_name = createChoice, unchecked_return_type = "CloudInfo")]
pub fn create_choice(
    length: u32,
    candidates: u32,
    count: Option<f64>,
    share: f64,
    weights: Option<Float64Array>,
) -> Result<JsValue, JsValue> {
    let weights = weights.as_ref().map(numbers).transpose()?;
    let placing = Placing {
        count: count.map(|count| count as usize),
        share: Some(share),
        weights: weights.as_deref(),
    };
    created(Choice::new(&placing).and_then(|mut choice| {
        choice.reserve(length as usize, candidates as usize)?;
        let mut kept = with_capacity(candidates as usize)?;
        kept.resize_with(candidates as usize, || None);
        Ok(Cloud::Choice(Box::new(Placed {
            choice,
            kept,
            bytes: 0,
            last: None,
            is_begun: false,
        })))
    }))
}

/// Takes the view of a candidate: the indices that it sees.
#[wasm_bindgen(js_name = takeView)]
pub fn take_view(handle: u32, candidate: u32, indices: &Uint32Array) -> Result<(), JsValue> {
    let mut view = copy_in_integers(indices)?;
    with_choice(handle, &mut |placed| {
        let (candidate, view) = (candidate as usize, core::mem::take(&mut view));
        if !placed.is_begun {
            placed.choice.take(candidate, &view);
        }
        placed.bytes += size_of_val(view.as_slice());
        if placed.bytes <= MOST_KEPT {
            placed.kept[candidate] = Some(view);
        } else {
            placed.bytes -= size_of_val(view.as_slice());
            placed.last = Some((candidate, view));
        }
        Ok(())
    })
}

/// Chooses as far as the views allow. Returns the candidate whose view is needed to go on: -1 at the end.
#[wasm_bindgen(js_name = chooseOn)]
pub fn choose_on(handle: u32) -> Result<f64, JsValue> {
    let mut wanted = None;
    with_choice(handle, &mut |placed| {
        placed.is_begun = true;
        let view_of = |number: usize| match (&placed.kept[number], &placed.last) {
            (Some(view), _) => Some(view.as_slice()),
            (None, Some((last, view))) if *last == number => Some(view.as_slice()),
            _ => None,
        };
        wanted = placed.choice.go_on(&view_of);
        Ok(())
    })?;
    Ok(wanted.map_or(-1.0, |number| number as f64))
}

/// What was chosen.
#[wasm_bindgen(unchecked_return_type = "PlacementAnswer")]
pub fn placed(handle: u32) -> Result<JsValue, JsValue> {
    let mut answer = JsValue::UNDEFINED;
    with_choice(handle, &mut |placed| {
        let placement = placed.choice.placed()?;
        let mut chosen = with_capacity(placement.chosen.len())?;
        chosen.extend(placement.chosen.iter().map(|&number| number as f64));
        answer = object(&[
            ("chosen", &list(&chosen)),
            ("gains", &list(&placement.gains)),
            ("seen", &copy_out(&placement.seen)?.into()),
            ("unseen", &copy_out(&placement.unseen)?.into()),
        ]);
        Ok(())
    })?;
    Ok(answer)
}

fn with_choice(
    handle: u32,
    act: &mut dyn FnMut(&mut Placed) -> Result<(), Error>,
) -> Result<(), JsValue> {
    change_any(handle, &mut |cloud| match cloud {
        Cloud::Choice(placed) => act(placed),
        _ => Ok(()),
    })?;
    Ok(())
}
