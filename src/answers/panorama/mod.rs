//! What stands in each direction around a viewpoint, as an image.
//!
//! INPUT    a cloud, a viewpoint, the options of a view, the size of an image.
//! OUTPUT   for each direction a distance and a point, or the sky; how much of the sphere is surface.
//! SUMMARY  The visible points are flipped once more, so far that all of them are vertices. The outer
//!          faces then are the Delaunay triangles of their directions. A triangle is surface if its
//!          corners are as near to each other as samples are (`surface`). The ray of each pixel walks
//!          to its triangle. The areas are those of the triangles, not of pixels.

mod surface;

use alloc::vec::Vec;
use core::f64::consts::{PI, TAU};

use glam::DVec3;
use surface::Surface;

use crate::answers::memory::ViewMemory;
use crate::base::allocation::filled;
use crate::base::beat;
use crate::base::error::{Error, in_range};
use crate::base::real::{power_of_two_below, sine_cosine, smaller, square_root};
use crate::cloud::point_cloud::PointCloud;
use crate::cloud::sequence::Sequence;
use crate::flip::inversion::Flip;
use crate::flip::kernel::Kernel;
use crate::hull::{self, OuterFaces};
use crate::view::options::Options;
use crate::view::refusals::QuestionKind;
use crate::view::resolved::normalized;

/// The largest width and height.
const MOST: f64 = 16_384.0;
/// +x is parallel to up if the sine of their angle is at most this.
const PARALLEL: f64 = 1e-9;

/// The size of a [`Panorama`](crate::Panorama), and where it is up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PanoramaOptions {
    /// The number of columns, 1 to 16384.
    pub width: usize,
    /// The number of rows, 1 to 16384.
    pub height: usize,
    /// The direction above the first row, of any length but 0. Column 0 looks along the part of +x that is
    /// perpendicular to it, or of +y where +x is parallel to it.
    pub up: [f64; 3],
}

impl Default for PanoramaOptions {
    fn default() -> Self {
        Self {
            width: 1024,
            height: 512,
            up: [0.0, 0.0, 1.0],
        }
    }
}

impl PanoramaOptions {
    pub(super) fn image(&self) -> Result<Image, Error> {
        let Self { width, height, up } = *self;
        in_range("width", width as f64, 1.0, MOST)?;
        in_range("height", height as f64, 1.0, MOST)?;
        let up = normalized(up).ok_or(Error::Direction { direction: up })?;
        let across = |axis: DVec3| {
            let across = axis - up * up.dot(axis);
            (across, square_root(across.length_squared()))
        };
        let (mut first, mut length) = across(DVec3::X);
        if length <= PARALLEL {
            (first, length) = across(DVec3::Y);
        }
        let first = first / length;
        Ok(Image {
            width,
            height,
            up,
            first,
            second: up.cross(first),
        })
    }
}

/// The pixels of a panorama.
pub(super) struct Image {
    pub width: usize,
    pub height: usize,
    pub up: DVec3,
    /// Where column 0 looks.
    first: DVec3,
    /// Where the column at a quarter of the width looks.
    second: DVec3,
}

impl Image {
    pub fn pixels(&self) -> usize {
        self.width * self.height
    }

    /// The direction of a pixel's middle, of length 1.
    pub fn direction(&self, row: usize, column: usize) -> DVec3 {
        let (across, along) = sine_cosine(PI * (row as f64 + 0.5) / self.height as f64);
        let (sin, cos) = sine_cosine(TAU * column as f64 / self.width as f64);
        (self.first * cos + self.second * sin) * across + self.up * along
    }
}

/// R in farthest distances: a point hides another one only if they are within about 10⁻⁴ radians.
const FLAT: f64 = 1e8;

/// What stands in each direction around a viewpoint.
///
/// The image is equirectangular, row after row from up to down. The middle of pixel (row, column) looks
/// at the elevation 90° − 180°·(row + ½)/height. Its azimuth is 360°·column/width, from +x to up × x: for
/// the usual up, from +x to +y.
#[derive(Clone, Debug, PartialEq)]
pub struct Panorama {
    /// The distance to the surface in each direction, in the cloud's units; infinity for the sky.
    pub ranges: Vec<f32>,
    /// The nearest visible point by angle; [`Panorama::SKY`] for the sky.
    pub indices: Vec<u32>,
    /// The share of the sky in the upper half of the sphere, weighted by the cosine from up: 0 to 1.
    pub sky_view_factor: f64,
    /// How much of the sphere is surface, in steradians.
    pub solid_angle: f64,
}

impl Panorama {
    /// The index of the sky.
    pub const SKY: u32 = u32::MAX;
}

impl PointCloud {
    /// What stands in each direction around `viewpoint`: the surface of the visible points of
    /// [`PointCloud::visible_from`] with the same options. The sky is where no visible surface stands: a
    /// triangle between visible points is surface if its edges, in local spacings, are at most 2.5 times as long as those
    /// of nine in ten triangles that face the viewer, in space or by angle. The lowest index stands for equal points.
    ///
    /// ```
    /// use hidden_point_removal::{Options, Panorama, PanoramaOptions, PointCloud};
    ///
    /// let cloud = PointCloud::new(&[[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [0.0, -1.0, 1.0]])?;
    /// let size = PanoramaOptions { width: 8, height: 4, ..PanoramaOptions::default() };
    /// let panorama = cloud.panorama([0.0; 3], &Options::default(), &size)?;
    /// assert_eq!(panorama.indices[0], 0);
    /// assert_eq!(panorama.indices[31], Panorama::SKY);
    /// # Ok::<(), hidden_point_removal::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutOfRange`] and [`Error::Direction`] for `panorama`; [`Error::Excludes`] for
    /// `scores`; otherwise as [`PointCloud::visible_from`].
    pub fn panorama(
        &self,
        viewpoint: [f64; 3],
        options: &Options,
        panorama: &PanoramaOptions,
    ) -> Result<Panorama, Error> {
        self.panorama_with(&mut ViewMemory::new(), viewpoint, options, panorama)
    }

    /// [`PointCloud::panorama`] with the memory of earlier views.
    #[inline(never)]
    pub(crate) fn panorama_with(
        &self,
        memory: &mut ViewMemory,
        viewpoint: [f64; 3],
        options: &Options,
        panorama: &PanoramaOptions,
    ) -> Result<Panorama, Error> {
        options.check(QuestionKind::Panorama)?;
        let image = panorama.image()?;
        let part = self.part(Some(viewpoint), options)?;
        memory.see(options.region(Some(viewpoint))?);
        let seen = part.seen_by(memory, viewpoint, options)?;
        let mut is_hidden = filled(part.len(), true)?;
        for &index in seen.indices() {
            is_hidden[index as usize] = false;
        }
        let shown = part.sequence.without(&|index| is_hidden[index as usize])?;
        let farthest = part
            .blocks
            .farthest_distance(&part.sequence.points, viewpoint)?;
        let mut made = Panorama {
            ranges: filled(image.pixels(), f32::INFINITY)?,
            indices: filled(image.pixels(), Panorama::SKY)?,
            sky_view_factor: 1.0,
            solid_angle: 0.0,
        };
        made.paint(&shown, viewpoint, farthest, &image)?;
        Ok(made)
    }
}

impl Panorama {
    /// Fills the image and the areas with the visible points.
    fn paint(
        &mut self,
        shown: &Sequence,
        viewpoint: [f64; 3],
        farthest: f64,
        image: &Image,
    ) -> Result<(), Error> {
        let points = &shown.points;
        let radius = (FLAT * farthest).min(0.5 * f64::MAX);
        let flip = Flip::new(viewpoint, Kernel::Spherical { radius }).rescaled_for(points);
        let mut memory = hull::Memory::new();
        hull::complete(points, &flip, &mut memory)?;
        let Some(mut faces) = memory.outer_faces(points, &flip, farthest)? else {
            return Ok(());
        };
        let unit = power_of_two_below((1.0 / farthest).min(f64::MAX));
        let origin = DVec3::from_array(viewpoint);
        let place = |own: u32| (DVec3::from_array(points.get(own as usize)) - origin) * unit;
        let surface = Surface::of(&faces, &place)?;
        let areas = surface.areas(&faces, &|vertex| faces.flipped(vertex), image.up);
        for row in 0..image.height {
            for column in 0..image.width {
                beat::step_at(column);
                let direction = image.direction(row, column);
                let Some((face, corners)) = faces.exit_towards(direction * farthest) else {
                    continue;
                };
                if let Some((range, vertex)) = surface.at(face, corners, direction) {
                    let own = faces.points_of_vertices()[vertex as usize];
                    let pixel = row * image.width + column;
                    // Infinity is the sky.
                    self.ranges[pixel] = smaller(range / unit, f64::from(f32::MAX)) as f32;
                    let indices = shown.indices_of(own as usize).iter().copied();
                    self.indices[pixel] = indices.min().unwrap_or(Panorama::SKY);
                }
            }
        }
        self.solid_angle = areas.solid_angle();
        self.sky_view_factor = areas.sky_view_factor();
        Ok(())
    }
}
