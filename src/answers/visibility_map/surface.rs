//! Distances for maps that stand in for looks.
//!
//! Looks show points that no single hull shows, so what certainly hides for one hull may hide them. A map of
//! looks decides as looks do, with wider margins, since it has fewer points. A point is hidden that lies
//! farther behind the triangle of champions before it, back in its place, than some times the triangle's longest edge, and
//! that the gauge of a loose hull hides as well. This is not proved; docs/LOOKS.md tells
//! how often it is wrong. To take only triangles of few local spacings, as looks do, or the gauge of a tighter look finds more in
//! scans, but hides up to 17 % of what looks show through sparse walls.

use glam::Vec4;

use crate::answers::visibility_map::gauge::NONE;
use crate::answers::visibility_map::grid::Grid;
use crate::answers::visibility_map::levels::{Corner, Row, Scale, Triangles};
use crate::base::allocation::{OutOfMemory, copied};

/// How many longest edges behind its triangle a point is hidden, where a map stands in for looks.
const EDGES: f32 = 4.0;
/// How far into a cell an edge reaches: a camera that has moved on sees past it.
const BESIDE: f32 = 0.25;

impl Corner<'_> {
    /// How far points are hidden along the corners: `behind` and some longest edges behind the nearer one of two triangles.
    #[inline(always)]
    pub(super) fn surface(&self, rows: [&Row; 2], at: usize, bend: f32, behind: f32) -> Vec4 {
        let [a, b, c, d] = self.champions;
        let far = |row: usize, at: usize| Vec4::from_slice(&rows[row].d[at..]);
        let [da, db, dc, dd] = [far(0, at - 1), far(0, at), far(1, at), far(1, at - 1)];
        let edge = |p: [Vec4; 3], of_p: Vec4, q: [Vec4; 3], of_q: Vec4| {
            let (x, y, z) = (p[0] - q[0], p[1] - q[1], of_p - of_q);
            z * z + of_p * of_q * (x * x + y * y) * (2.0 * bend)
        };
        let (ab, bc) = (edge(a, da, b, db), edge(b, db, c, dc));
        let (cd, ad) = (edge(c, dc, d, dd), edge(d, dd, a, da));
        let (ac, bd) = (edge(a, da, c, dc), edge(b, db, d, dd));
        let Triangles { weights, picks } = self.triangles();
        let pick = Vec4::select;
        let one = self.behind(
            weights[0],
            [da, pick(picks[0], db, dd), dc],
            ac.max(pick(picks[0], ab.max(bc), cd.max(ad))),
        );
        let two = self.behind(
            weights[1],
            [db, pick(picks[1], dc, da), dd],
            bd.max(pick(picks[1], bc.max(cd), ad.max(ab))),
        );
        one.min(two) + behind
    }

    #[inline(always)]
    fn behind(&self, [p, q, r]: [Vec4; 3], [of_p, of_q, of_r]: [Vec4; 3], edge: Vec4) -> Vec4 {
        let &Scale { error, area, .. } = self.scale;
        let sum = p + q + r;
        let depth = sum / (p / of_p + q / of_q + r / of_r);
        let is_sure = p.min(q).min(r).cmpge(Vec4::splat(error)) & sum.cmpge(Vec4::splat(area));
        let far = depth + edge.sqrt() * EDGES;
        Vec4::select(
            is_sure & far.cmplt(Vec4::splat(1e16)),
            far,
            Vec4::splat(NONE),
        )
    }
}

/// Takes the distance of each corner a part of the way to those beside it that are larger. A surface with a thickness shows what
/// lies at most `aside` beside its outline, where a point seen there is among the six nearest by direction. These are hardly
/// farther than a cell.
pub(super) fn spread(grid: &Grid, aside: f64, distances: &mut [f32]) -> Result<(), OutOfMemory> {
    let before = copied(distances)?;
    let cells = (aside * grid.cells_per_unit) as f32;
    let count = if aside > 0.0 { 8 } else { 4 };
    for (_, window) in grid.used() {
        let corners = window.first..window.first + window.corners();
        let before = &before[corners.clone()];
        let across = window.columns + 1;
        for (at, distance) in distances[corners].iter_mut().enumerate() {
            // Positive numbers are in the order of their bits. No processor can guess a branch here.
            let mut most = distance.to_bits();
            // Beyond the end of a row comes another one: a border may hide less.
            let around = [1, across, across - 1, across + 1];
            let around = around.map(|by| [at.wrapping_sub(by), at + by]);
            for &beside in around.as_flattened().iter().take(count) {
                most = before
                    .get(beside)
                    .map_or(most, |other| most.max(other.to_bits()));
            }
            let share = (cells / *distance).clamp(BESIDE, 1.0);
            *distance += (f32::from_bits(most) - *distance) * share;
        }
    }
    Ok(())
}
