//! The clouds, each with the number that JavaScript holds, and the hull of the last view.

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::cell::RefCell;
use std::thread_local;

use wasm_bindgen::prelude::*;

use crate::answers::memory::ViewMemory;
#[cfg(feature = "wasm")]
use crate::answers::transfer::Transfer;
use crate::base::FULL;
use crate::base::allocation::push;
use crate::wasm::answer::{disposed, numbered};
use crate::wasm::options::ViewOptions;
use crate::wasm::transfer::copy_in_bytes;
#[cfg(feature = "wasm")]
use crate::{Choice, Horizon, PointCloudNd};
use crate::{Error, Options, PointCloud};

thread_local! {
    static CLOUDS: RefCell<Vec<Option<Cloud>>> = const { RefCell::new(Vec::new()) };
    static LAST_VIEWS: RefCell<[Option<LastView>; 2]> = const { RefCell::new([None, None]) };
}

/// A cloud of three dimensions (or two, with z = 0), or of more; or what is made of the views of one.
pub(super) enum Cloud {
    Space(Box<PointCloud>),
    #[cfg(feature = "wasm")]
    Hyper(Box<PointCloudNd>),
    #[cfg(feature = "wasm")]
    Horizon(Box<Horizon>),
    #[cfg(feature = "wasm")]
    Transfer(Box<Transfer>),
    #[cfg(feature = "wasm")]
    Choice(Box<Placed>),
}

/// A choice among candidates, and views of them.
#[cfg(feature = "wasm")]
pub(super) struct Placed {
    pub choice: Choice,
    pub kept: Vec<Option<Vec<u32>>>,
    pub bytes: usize,
    /// The last view, if it is not kept.
    pub last: Option<(usize, Vec<u32>)>,
    pub is_begun: bool,
}

/// The hull of a view. A view in slices goes on from it. All clouds share two, the newer first, so that many
/// clouds take no more memory, and a view in slices is kept while other clouds are asked in between.
struct LastView {
    handle: u32,
    /// Whether only masked points took part.
    masked: bool,
    memory: ViewMemory,
}

/// The number and the size of a cloud.
fn info(handle: u32, cloud: &Cloud) -> Result<JsValue, Error> {
    let (length, skipped, spacing) = match cloud {
        Cloud::Space(cloud) => (cloud.len(), cloud.skipped(), cloud.spacing()?),
        #[cfg(feature = "wasm")]
        Cloud::Hyper(cloud) => (cloud.len(), cloud.skipped(), cloud.spacing()),
        #[cfg(feature = "wasm")]
        _ => (0, 0, 0.0),
    };
    Ok(numbered(&[
        ("handle", f64::from(handle)),
        ("length", length as f64),
        ("skipped", skipped as f64),
        ("spacing", spacing),
    ]))
}

/// Keeps a cloud that was not refused.
pub(super) fn created(made: Result<Cloud, Error>) -> Result<JsValue, JsValue> {
    let cloud = made?;
    CLOUDS.with_borrow_mut(|clouds| {
        let free = clouds.iter().position(Option::is_none);
        let slot = free.unwrap_or(clouds.len());
        if free.is_none() {
            push(clouds, None).map_err(Error::from)?;
        }
        let info = info(slot as u32, &cloud)?;
        clouds[slot] = Some(cloud);
        Ok(info)
    })
}

/// Frees a cloud; its number may be given to another one afterwards.
#[wasm_bindgen(js_name = freeCloud)]
pub fn free_cloud(handle: u32) {
    forget(handle);
    CLOUDS.with_borrow_mut(|clouds| {
        if let Some(slot) = clouds.get_mut(handle as usize) {
            *slot = None;
        }
    });
}

pub(super) fn with_cloud<T>(
    handle: u32,
    query: impl FnOnce(&PointCloud) -> Result<T, Error>,
) -> Result<T, JsValue> {
    CLOUDS.with_borrow(|clouds| match clouds.get(handle as usize) {
        Some(Some(Cloud::Space(cloud))) => query(cloud).map_err(JsValue::from),
        _ => Err(disposed()),
    })
}

/// Asks a cloud for a view, or the part of it that a mask leaves. The part is kept for the next view, where there is
/// memory. `viewpoint` is the one viewpoint of the view, if there is one.
#[cfg(feature = "wasm")]
pub(super) fn with_view<T>(
    handle: u32,
    viewpoint: Option<[f64; 3]>,
    choices: &ViewOptions,
    options: &Options,
    query: impl FnOnce(&PointCloud) -> Result<T, Error>,
) -> Result<T, JsValue> {
    let masked = prepare(handle, viewpoint, choices, options)?;
    with_cloud(handle, |cloud| query(part(cloud, masked)))
}

/// The same with the memory of the last view. A view of another cloud, or of other points of it, is forgotten first.
pub(super) fn with_memory<T>(
    handle: u32,
    viewpoint: [f64; 3],
    choices: &ViewOptions,
    options: &Options,
    query: impl FnOnce(&PointCloud, &mut ViewMemory) -> Result<T, Error>,
) -> Result<T, JsValue> {
    let masked = prepare(handle, Some(viewpoint), choices, options)?;
    with_cloud(handle, |cloud| {
        LAST_VIEWS
            .with_borrow_mut(|last| query(part(cloud, masked), memory_for(last, handle, masked)))
    })
}

/// How far measured points lie off their surface.
#[cfg(feature = "wasm")]
#[wasm_bindgen]
pub fn noise(handle: u32) -> Result<f64, JsValue> {
    CLOUDS.with_borrow(|clouds| match clouds.get(handle as usize) {
        Some(Some(Cloud::Space(cloud))) => cloud.noise().map_err(JsValue::from),
        Some(Some(_)) => Ok(0.0),
        _ => Err(disposed()),
    })
}

/// What the survey of the points found: 0 a clean surface, 1 a noisy one, 2 layers.
#[cfg(feature = "wasm")]
#[wasm_bindgen]
pub fn surface(handle: u32) -> Result<u32, JsValue> {
    CLOUDS.with_borrow(|clouds| match clouds.get(handle as usize) {
        Some(Some(Cloud::Space(cloud))) => Ok(cloud.surface()? as u32),
        Some(Some(_)) => Ok(0),
        _ => Err(disposed()),
    })
}

/// The cloud, or the part of it that the last mask left.
fn part(cloud: &PointCloud, is_masked: bool) -> &PointCloud {
    match &cloud.kept.masked {
        Some((_, part)) if is_masked => part,
        _ => cloud,
    }
}

/// Keeps what the next view needs, where there is memory. Returns whether a mask chooses points.
#[inline(never)]
fn prepare(
    handle: u32,
    viewpoint: Option<[f64; 3]>,
    choices: &ViewOptions,
    options: &Options,
) -> Result<bool, JsValue> {
    let mask = choices.mask();
    if mask.is_none() && options.within.is_none() {
        return Ok(false);
    }
    CLOUDS.with_borrow_mut(|clouds| match clouds.get_mut(handle as usize) {
        Some(Some(Cloud::Space(cloud))) => {
            if let Some(mask) = &mask {
                let is_new = copy_in_bytes(mask).and_then(|mask| cloud.keep_masked(mask))?;
                if is_new {
                    forget(handle);
                }
            }
            let cloud = match &mut cloud.kept.masked {
                Some((_, part)) if mask.is_some() => part,
                _ => cloud,
            };
            match cloud.keep_part(viewpoint, options) {
                Ok(()) | Err(Error::OutOfMemory) => Ok(mask.is_some()),
                Err(refused) => Err(refused.into()),
            }
        }
        _ => Err(disposed()),
    })
}

/// Whether the cloud has more than three dimensions.
#[cfg(feature = "wasm")]
pub(super) fn is_hyper(handle: u32) -> bool {
    CLOUDS.with_borrow(|clouds| {
        let cloud = clouds.get(handle as usize);
        matches!(cloud, Some(Some(Cloud::Hyper(_))))
    })
}

#[cfg(feature = "wasm")]
pub(super) fn with_hyper<T>(
    handle: u32,
    query: impl FnOnce(&PointCloudNd) -> Result<T, Error>,
) -> Result<T, JsValue> {
    CLOUDS.with_borrow(|clouds| match clouds.get(handle as usize) {
        Some(Some(Cloud::Hyper(cloud))) => query(cloud).map_err(JsValue::from),
        _ => Err(disposed()),
    })
}

#[cfg(feature = "wasm")]
pub(super) fn with_horizon<T>(
    handle: u32,
    query: impl FnOnce(&Horizon) -> Result<T, Error>,
) -> Result<T, JsValue> {
    CLOUDS.with_borrow(|clouds| match clouds.get(handle as usize) {
        Some(Some(Cloud::Horizon(horizon))) => query(horizon).map_err(JsValue::from),
        _ => Err(disposed()),
    })
}

fn memory_for(last: &mut [Option<LastView>; 2], handle: u32, masked: bool) -> &mut ViewMemory {
    let is_of = |view: &Option<LastView>| view.as_ref().is_some_and(|last| last.handle == handle);
    if !is_of(&last[0]) {
        last.swap(0, 1);
    }
    let newest = last[0].get_or_insert_with(|| LastView {
        handle,
        masked,
        memory: ViewMemory::new(),
    });
    if (newest.handle, newest.masked) != (handle, masked) {
        newest.memory.forget();
        (newest.handle, newest.masked) = (handle, masked);
    }
    &mut newest.memory
}

/// Frees the memory of the cloud's last view.
fn forget(handle: u32) {
    if !FULL {
        return;
    }
    LAST_VIEWS.with_borrow_mut(|views| {
        for last in views {
            if last.as_ref().is_some_and(|last| last.handle == handle) {
                *last = None;
            }
        }
    });
}

/// Changes a cloud of any dimension.
pub(super) fn change_any(
    handle: u32,
    change: &mut dyn FnMut(&mut Cloud) -> Result<(), Error>,
) -> Result<JsValue, JsValue> {
    forget(handle);
    CLOUDS.with_borrow_mut(|clouds| {
        let cloud = clouds.get_mut(handle as usize).and_then(Option::as_mut);
        let cloud = cloud.ok_or_else(disposed)?;
        change(cloud)?;
        Ok(info(handle, cloud)?)
    })
}
