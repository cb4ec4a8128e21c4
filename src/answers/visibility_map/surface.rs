//! From the triangles of a hull to distances, for maps that stand in for looks.
//!
//! Looks show points that no single hull shows, so what certainly hides for one hull may hide them. A map of
//! looks decides as looks do, with wider margins, since it has fewer points. A point is hidden that lies
//! farther behind the triangle before it, back in its place, than the triangle's longest edge allows, and that the
//! map's hull hides as well: where looks are loose, as at far ground, both differ. This is not proved; docs/LOOKS.md tells
//! how often it is wrong.

use glam::DVec3;

use crate::answers::looks::{Corners, Depth, Triangle, longest_of};
use crate::answers::visibility_map::depths::{NOWHERE, each_corner, stored};
use crate::answers::visibility_map::hides::VisibilityMap;
use crate::base::allocation::{OutOfMemory, copied, filled, with_capacity};
use crate::base::error::Error;
use crate::base::real::{larger, smaller, square_root};
use crate::cloud::points::Points;
use crate::flip::inversion::Flip;
use crate::hull::{Memory, Reaches, Window, direction};

/// How many longest edges behind it a triangle hides a point: one that is surface, and another one.
const BEHIND: [f64; 2] = [2.0, 4.0];
/// How far into a cell an edge reaches: a camera that has moved on sees past it.
const BESIDE: f32 = 0.25;
/// The triangles along one in so many corners tell how long those of a surface are.
const SAMPLE: usize = 16;
/// The hull of a map, and where points may be visible besides.
pub(super) struct Look<'a> {
    pub hull: &'a mut Memory,
    pub points: &'a Points,
    pub flip: &'a Flip,
    pub farthest: f64,
    pub depth: Depth,
}

impl VisibilityMap {
    /// Writes the distances behind the triangles of a look.
    pub(super) fn fill_by_surface(&mut self, look: Look, count: usize) -> Result<(), Error> {
        let Look {
            hull,
            points,
            flip,
            farthest,
            depth: Depth { behind, aside },
        } = look;
        let place = |own: u32| DVec3::from_array(points.get(own as usize)) - flip.viewpoint();
        let Some(faces) = hull.outer_faces(points, flip, farthest)? else {
            return Ok(());
        };
        let corners = Corners::of(&faces, &place, &|_| f64::INFINITY)?;
        let Some(reaches) = hull.reaches(count)? else {
            return Ok(());
        };
        let mut lengths = with_capacity(reaches.faces.len().div_ceil(SAMPLE))?;
        each_triangle(
            hull,
            &reaches,
            &corners,
            SAMPLE,
            &mut |_, ahead, triangle| {
                if triangle.is_facing(ahead, None) {
                    lengths.push(triangle.longest / triangle.size);
                }
            },
        );
        let longest = longest_of(&lengths)?;
        let mut distances = filled(reaches.faces.len(), NOWHERE)?;
        each_triangle(
            hull,
            &reaches,
            &corners,
            1,
            &mut |place, ahead, triangle| {
                let length = square_root(ahead.length_squared());
                let before = triangle.crossing(ahead) * length;
                let is_surface = triangle.longest <= longest * triangle.size;
                let behind = BEHIND[usize::from(!is_surface)] * triangle.longest + behind;
                if before > 0.0 {
                    let reach = length / reaches.heights[place];
                    distances[place] = stored(larger(before + behind, flip.distance_at(reach)));
                }
            },
        );
        if aside > 0.0 {
            widen(&reaches, aside, &mut distances)?;
        }
        spread(&reaches.windows, &mut distances)?;
        self.set(&reaches, &distances)?;
        Ok(())
    }
}

/// Takes the distance of each corner a part of the way to those beside it that are larger.
fn spread(windows: &[Window; 6], distances: &mut [f32]) -> Result<(), OutOfMemory> {
    let before = copied(distances)?;
    for window in windows {
        let corners = window.first..window.first + window.corners();
        let before = &before[corners.clone()];
        let across = window.columns + 1;
        for (at, distance) in distances[corners].iter_mut().enumerate() {
            // Positive numbers are in the order of their bits. No processor can guess a branch here.
            let mut most = distance.to_bits();
            // Beyond the end of a row comes another one: a border may hide less.
            let (left, below) = (at.wrapping_sub(1), at.wrapping_sub(across));
            for beside in [left, at + 1, below, at + across] {
                most = before
                    .get(beside)
                    .map_or(most, |other| most.max(other.to_bits()));
            }
            *distance += (f32::from_bits(most) - *distance) * BESIDE;
        }
    }
    Ok(())
}

/// Gives each corner the largest distance of those that are at most `aside` beside it, where its surface is: a surface with
/// a thickness shows what lies so near to its outline.
fn widen(reaches: &Reaches, aside: f64, distances: &mut [f32]) -> Result<(), OutOfMemory> {
    let cell = 1.0 / reaches.cells_per_unit;
    let mut cells = with_capacity(distances.len())?;
    let shares = distances
        .iter()
        .map(|&distance| aside / f64::from(distance));
    cells.extend(shares);
    for window in &reaches.windows {
        each_corner(window, cell, &mut |place, _, squared| {
            cells[place] *= squared / cell;
        });
        let corners = window.first..window.first + window.corners();
        let (own, cells) = (&mut distances[corners.clone()], &cells[corners]);
        let across = window.columns + 1;
        let mut wider = copied(own)?;
        for wide in &mut wider {
            // Nothing is seen there.
            if *wide == NOWHERE {
                *wide = 0.0;
            }
        }
        let most = cells.iter().fold(0.0, |most, &cells| larger(most, cells));
        let mut width = 0;
        while (width as f64) < smaller(most, wider.len() as f64) {
            let before = width as f64;
            // Without a gap: from [-a, a] to [-a - s, a + s], where s is at most 2a + 1.
            let step = 2 * width + 1;
            for by in [step, step * across] {
                let narrow = copied(&wider)?;
                for (at, widest) in wider.iter_mut().enumerate() {
                    for beside in [at.wrapping_sub(by), at + by] {
                        let other = narrow.get(beside).copied().unwrap_or(0.0);
                        if other > *widest {
                            *widest = other;
                        }
                    }
                }
            }
            width += step;
            for ((own, &wide), &cells) in own.iter_mut().zip(&wider).zip(cells) {
                if cells > before && *own < NOWHERE {
                    *own = wide;
                }
            }
        }
    }
    Ok(())
}

/// Passes the triangle along every `step`th corner, the corner's index and its direction.
fn each_triangle(
    hull: &Memory,
    reaches: &Reaches,
    corners: &Corners,
    step: usize,
    pass: &mut dyn FnMut(usize, DVec3, Triangle),
) {
    let cell = 1.0 / reaches.cells_per_unit;
    for (side, window) in reaches.windows.iter().enumerate() {
        each_corner(window, cell, &mut |place, [x, y], _| {
            if place % step == 0 && reaches.heights[place] < f64::INFINITY {
                let vertices = hull.corners(reaches.faces[place]);
                let triangle = Triangle::of(vertices, corners);
                pass(place, direction(side, x, y), triangle);
            }
        });
    }
}
