//! The points of a cloud of any dimension: rows of numbers, their order by coordinates, and
//! statistics measured in this order. Points and viewpoints that differ in at most three coordinates are a cloud in space.

use alloc::vec::Vec;

use crate::base::allocation::{OutOfMemory, filled, reserve, with_capacity};
use crate::base::error::Error;
use crate::base::real::square_root;
use crate::base::sort::{ordered, sort_by_numbers};
use crate::cloud::point_cloud::{NonFinite, PointCloud};
use crate::cloud::points::checked_len;
use crate::cloud::surface;
use crate::dimensions::flat::{Flat, columns};

/// The spacing of a point is its mean distance from `NEIGHBORS` points; it is measured at
/// `SAMPLES` points.
const NEIGHBORS: usize = 6;
const SAMPLES: usize = 512;

pub(super) struct Rows {
    pub dimension: usize,
    /// The row of every index ever given. No number is -0.
    pub coordinates: Vec<f64>,
    pub present: Vec<bool>,
    /// The present indices sorted by coordinates, and where each distinct point starts.
    order: Vec<u32>,
    starts: Vec<u32>,
    pub measures: Measures,
    pub flat: Flat,
}

/// What the automatic radius is computed from, as in [`Statistics`].
///
/// [`Statistics`]: crate::cloud::statistics::Statistics
#[derive(Default)]
pub(super) struct Measures {
    pub centroid: Vec<f64>,
    pub spacing: f64,
    pub gap: f64,
    pub middle: Vec<f64>,
    pub variance: f64,
}

impl Rows {
    pub(super) fn new(dimension: usize) -> Self {
        Self {
            dimension,
            coordinates: Vec::new(),
            present: Vec::new(),
            order: Vec::new(),
            starts: Vec::new(),
            measures: Measures::default(),
            flat: Flat::default(),
        }
    }

    /// How many rows were given.
    pub(super) fn len(&self) -> usize {
        self.present.len()
    }

    /// How many distinct points there are.
    pub(super) fn distinct(&self) -> usize {
        self.starts.len()
    }

    /// The coordinates of distinct point `point`, in the order by coordinates.
    pub(super) fn at(&self, point: usize) -> &[f64] {
        self.row(self.order[self.starts[point] as usize])
    }

    /// The indices of distinct point `point`.
    pub(super) fn indices_of(&self, point: usize) -> &[u32] {
        let end = self.starts.get(point + 1);
        let end = end.map_or(self.order.len(), |&end| end as usize);
        &self.order[self.starts[point] as usize..end]
    }

    /// Adds rows, all or none; returns how many of them are not finite.
    pub(super) fn append(
        &mut self,
        coordinates: &[f64],
        non_finite: NonFinite,
    ) -> Result<usize, Error> {
        let (len, dimension) = (coordinates.len(), self.dimension);
        if len % dimension != 0 {
            return Err(Error::PositionsLength { len, dimension });
        }
        let count = len / dimension;
        checked_len(self.len().saturating_add(count))?;
        let rows = || coordinates.chunks_exact(dimension);
        let is_finite = |row: &[f64]| row.iter().all(|x| x.is_finite());
        let finite = rows().filter(|row| is_finite(row)).count();
        if finite < count && non_finite == NonFinite::Error {
            let first = rows().position(|row| !is_finite(row)).unwrap_or(0);
            let count = count - finite;
            return Err(Error::NonFinite { count, first });
        }
        let before = self.present.len();
        reserve(&mut self.coordinates, len)?;
        reserve(&mut self.present, count)?;
        // Adding 0 makes -0 the same as 0.
        self.coordinates.extend(coordinates.iter().map(|x| x + 0.0));
        self.present.extend(rows().map(is_finite));
        if let Err(error) = self.arrange() {
            self.coordinates.truncate(before * dimension);
            self.present.truncate(before);
            return Err(error.into());
        }
        Ok(count - finite)
    }

    pub(super) fn remove(&mut self, indices: &[u32]) -> Result<(), Error> {
        let len = self.len();
        if let Some(&index) = indices.iter().find(|&&index| index as usize >= len) {
            return Err(Error::IndexOutOfRange { index, len });
        }
        let mut before = with_capacity(len)?;
        before.extend_from_slice(&self.present);
        for &index in indices {
            self.present[index as usize] = false;
        }
        Ok(self.arrange().inspect_err(|_| self.present = before)?)
    }

    fn row(&self, index: u32) -> &[f64] {
        &self.coordinates[index as usize * self.dimension..][..self.dimension]
    }

    /// Sorts the present rows, and measures them in this order.
    fn arrange(&mut self) -> Result<(), OutOfMemory> {
        let mut keyed: Vec<(u64, u32)> = with_capacity(self.present.len())?;
        let present = (0..self.present.len() as u32).filter(|&i| self.present[i as usize]);
        keyed.extend(present.map(|i| (ordered(self.row(i)[0]), i)));
        sort_by_numbers(&mut keyed, self.dimension + 1, &|axis, i| {
            self.row(i).get(axis).map_or(u64::from(i), |&x| ordered(x))
        });
        let mut order: Vec<u32> = with_capacity(keyed.len())?;
        order.extend(keyed.iter().map(|&(_, i)| i));
        drop(keyed);
        let mut starts: Vec<u32> = with_capacity(order.len())?;
        for k in 0..order.len() {
            if k == 0 || self.row(order[k]) != self.row(order[k - 1]) {
                starts.push(k as u32);
            }
        }
        let order = core::mem::replace(&mut self.order, order);
        let starts = core::mem::replace(&mut self.starts, starts);
        let flat = Flat::of(self.distinct(), self.dimension, &|point| self.at(point));
        match flat.and_then(|flat| Ok((self.measure()?, flat))) {
            Ok((measures, flat)) => {
                (self.measures, self.flat) = (measures, flat);
                Ok(())
            }
            Err(error) => {
                (self.order, self.starts) = (order, starts);
                Err(error)
            }
        }
    }

    fn measure(&self) -> Result<Measures, OutOfMemory> {
        let count = self.starts.len();
        let mut measures = Measures {
            centroid: filled(self.dimension, 0.0)?,
            middle: filled(self.dimension, 0.0)?,
            ..Measures::default()
        };
        if count == 0 {
            return Ok(measures);
        }
        for axis in 0..self.dimension {
            // Coordinates relative to one point keep the detail of clouds far away.
            let origin = self.at(0)[axis];
            let sum: f64 = (0..count).map(|k| self.at(k)[axis] - origin).sum();
            measures.centroid[axis] = origin + sum / count as f64;
        }
        if count < 2 {
            return Ok(measures);
        }
        let samples = count.min(SAMPLES);
        let place = |sample| (2 * sample + 1) * count / (2 * samples);
        let mut spacings = with_capacity(samples)?;
        spacings.extend((0..samples).map(|sample| self.spacing_at(place(sample))));
        measures.spacing = surface::mean(&spacings);
        let longest = surface::longest(&spacings)?;
        let spacings = surface::cut_off(spacings, longest);
        measures.gap = surface::gap(&spacings);
        let areas = surface::into_areas(spacings);
        for axis in 0..self.dimension {
            let [mean, variance] = surface::moments(&areas, &|sample| self.at(place(sample))[axis]);
            measures.middle[axis] = mean;
            measures.variance += variance;
        }
        Ok(measures)
    }

    /// The mean distance of a distinct point from its nearest other points.
    fn spacing_at(&self, point: usize) -> f64 {
        let mut nearest = [f64::INFINITY; NEIGHBORS];
        for other in (0..self.starts.len()).filter(|&other| other != point) {
            let squared = squared(self.at(point), self.at(other));
            // The smallest distances, ascending.
            if let Some(place) = nearest.iter().position(|&least| squared < least) {
                nearest.copy_within(place..NEIGHBORS - 1, place + 1);
                nearest[place] = squared;
            }
        }
        let found = nearest.iter().filter(|squared| squared.is_finite());
        let count = found.clone().count().max(1);
        found.map(|&squared| square_root(squared)).sum::<f64>() / count as f64
    }
}

pub(super) fn squared(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |sum, (a, b)| sum + (a - b) * (a - b))
}

/// The cloud and the viewpoints in the subspace.
type InSpace = (PointCloud, Vec<[f64; 3]>);

/// `None` if the points and the viewpoints differ in more coordinates.
#[inline(never)]
pub(super) fn in_space(rows: &Rows, viewpoints: &[&[f64]]) -> Result<Option<InSpace>, Error> {
    let Some(first) = viewpoints.first() else {
        return Ok(None);
    };
    let differs = |axis: usize| {
        let x = first[axis];
        (0..rows.distinct()).any(|point| rows.at(point)[axis] != x)
            || viewpoints.iter().any(|viewpoint| viewpoint[axis] != x)
    };
    let mut kept = filled(rows.dimension, false)?;
    let mut count = 0;
    // Where they differ in fewer than three coordinates, any others follow.
    for own in [true, false] {
        for (axis, kept) in kept.iter_mut().enumerate() {
            if differs(axis) == own && (own || count < 3) {
                *kept = true;
                count += 1;
            }
        }
    }
    if count > 3 {
        return Ok(None);
    }
    let mut positions = columns(&rows.coordinates, &kept)?;
    for (place, present) in positions.chunks_exact_mut(3).zip(&rows.present) {
        if !present {
            place.fill(f64::NAN);
        }
    }
    let cloud = PointCloud::with_non_finite(&in_threes(&positions)?, NonFinite::Skip)?;
    let mut places: Vec<f64> = with_capacity(3 * viewpoints.len())?;
    for viewpoint in viewpoints {
        places.extend_from_slice(&columns(viewpoint, &kept)?);
    }
    Ok(Some((cloud, in_threes(&places)?)))
}

#[inline(never)]
fn in_threes(numbers: &[f64]) -> Result<Vec<[f64; 3]>, OutOfMemory> {
    let mut places = filled(numbers.len() / 3, [0.0; 3])?;
    places.as_flattened_mut().copy_from_slice(numbers);
    Ok(places)
}
