//! Distances for maps that stand in for looks.
//!
//! Looks show points that no single hull shows, so what certainly hides for one hull may hide them. A map of
//! looks decides as looks do, with wider margins, since it has fewer points. A point is hidden that lies
//! farther behind the triangle of champions before it, back in its place, than some times the triangle's longest edge, and
//! that the gauge of a loose hull hides as well. This is not proved; docs/LOOKS.md tells
//! how often it is wrong.

use crate::answers::looks::Depth;
use crate::answers::visibility_map::depths::{NOWHERE, each_corner, stored};
use crate::answers::visibility_map::grid::Grid;
use crate::answers::visibility_map::hides::VisibilityMap;
use crate::answers::visibility_map::levels::{Champions, Levels, UNKNOWN};
use crate::base::allocation::{OutOfMemory, copied, filled, with_capacity};
use crate::base::real::{larger, smaller, square_root};
use crate::flip::inversion::Flip;

/// How far into a cell an edge reaches: a camera that has moved on sees past it.
const BESIDE: f32 = 0.25;

impl VisibilityMap {
    /// Writes the distances behind the surfaces of a look.
    #[inline(never)]
    pub(super) fn fill_by_surface(
        &mut self,
        champions: &Champions,
        levels: &mut Levels,
        flip: &Flip,
        depth: &Depth,
    ) -> Result<(), OutOfMemory> {
        let grid = &champions.grid;
        let cell = 1.0 / grid.cells_per_unit;
        let mut distances = filled(grid.corners(), NOWHERE)?;
        for (side, window) in grid.used() {
            let bounds = levels.bounds(champions, side, flip)?;
            each_corner(window, cell, &mut |place, _, squared| {
                let bound = bounds[place - window.first];
                if bound < UNKNOWN {
                    distances[place] = stored(flip.distance_at(square_root(squared) / bound));
                }
            });
            let surface = levels.surface(champions, side, flip.viewpoint(), depth.behind)?;
            let both = distances[window.first..].iter_mut().zip(surface);
            for (distance, &surface) in both {
                *distance = distance.max(stored(surface));
            }
        }
        if depth.aside > 0.0 {
            widen(grid, depth.aside, &mut distances)?;
        }
        spread(grid, &mut distances)?;
        self.set(grid, &distances)
    }
}

/// Takes the distance of each corner a part of the way to those beside it that are larger.
fn spread(grid: &Grid, distances: &mut [f32]) -> Result<(), OutOfMemory> {
    let before = copied(distances)?;
    for (_, window) in grid.used() {
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
fn widen(grid: &Grid, aside: f64, distances: &mut [f32]) -> Result<(), OutOfMemory> {
    let cell = 1.0 / grid.cells_per_unit;
    let mut cells = with_capacity(distances.len())?;
    let shares = distances
        .iter()
        .map(|&distance| aside / f64::from(distance));
    cells.extend(shares);
    for (_, window) in grid.used() {
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
