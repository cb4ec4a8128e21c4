//! The thickness at which scanners see the points that they measured.
//!
//! INPUT    a cloud of scans, where each scanner stood, and which points it measured.
//! OUTPUT   a thickness for the looks.
//! SUMMARY  A thicker surface shows more of a scanner's own points, all of which are visible from it. It also shows more of
//!          the others: those that are visible, too, at the rate of the own ones, and those that are hidden. With a
//!          thickness of 0 hardly a hidden point is seen, which tells how many of the others are visible. So the
//!          share of the hidden ones that any thickness shows follows. The best thickness has the largest share of
//!          own points less that share. Thicknesses are tried from 0 upwards, each twice the one before, as long as a
//!          larger one may be better, then beside the best one.

use alloc::vec::Vec;

use crate::base::allocation::{filled, with_capacity};
use crate::base::error::Error;
use crate::base::real::{larger, smaller, square_root};
use crate::cloud::point_cloud::PointCloud;
use crate::view::options::{Inversion, Options};

/// More of a station's own points count as all of them: a few are noise.
const ENOUGH: f64 = 0.985;
/// The first thickness above 0, in spacings.
const FIRST: f64 = 0.125;
/// So often, thicknesses on both sides of the best one are tried.
const HALVINGS: usize = 2;
/// Each doubling of the thickness must bring such a share of own points.
const PRICE: f64 = 0.005;
/// If the stations see less of their own points on average, the answer says so.
const LOW: f64 = 0.9;

/// Where a scanner stood, and which points it measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station<'a> {
    /// Its place.
    pub viewpoint: [f64; 3],
    /// The indices of its points.
    pub indices: &'a [u32],
}

/// How looks are to be asked, so that scanners see the points that they measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// The thickness, in the cloud's units.
    pub thickness: f64,
    /// For each station, the share of its own points that this thickness sees. Points that cannot be seen do not
    /// count: removed and skipped ones, and those outside of [`Options::within`]. 1 if none can be seen.
    pub recall: Vec<f64>,
    /// Of the points that a station did not measure and does not see with a thickness of 0, the share that it sees with
    /// this one.
    pub shown: f64,
}

impl Calibration {
    /// Whether the stations see less than 0.9 of their own points on average, since a larger thickness would show more
    /// hidden points than own ones.
    #[must_use]
    pub fn is_low(&self) -> bool {
        mean(&self.recall, 1.0) < LOW
    }
}

/// What is seen with one thickness.
#[derive(Clone)]
struct Trial {
    thickness: f64,
    recall: Vec<f64>,
    /// How many other points each station sees, and how many there are.
    others: Vec<[usize; 2]>,
}

impl PointCloud {
    /// For scans whose stations are known: the thickness at which each station sees most of the points that it measured,
    /// and few others. Takes up to twenty views of each station. A thickness that `options` give is only measured.
    ///
    /// It is the one for which the mean recall (more than 0.985 of a station counts as 0.985), less the share of hidden points that are shown, is
    /// largest. Each doubling must bring half a percent of own points. Which others are hidden is estimated: with a
    /// thickness of 0, hardly a hidden one is seen, and visible ones at the rate of own ones.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`] for a station's indices; [`Error::Excludes`] unless `options` ask for
    /// [`Inversion::Looks`]; otherwise as [`PointCloud::visible_from`].
    pub fn calibrate(&self, stations: &[Station], options: &Options) -> Result<Calibration, Error> {
        if !matches!(options.inversion, Inversion::Looks(_)) {
            return Err(Error::Excludes {
                option: "calibrate",
                other: "an answer without looks",
            });
        }
        let options = options.with_scores(false);
        let first = self.trial(stations, &options, 0.0)?;
        if let Some(thickness) = options.thickness {
            let trial = self.trial(stations, &options, thickness)?;
            return Ok(trial.compared_with(&first));
        }
        let spacing = self.spacing()?;
        let value = |trial: &Trial| trial.value(&first, spacing);
        let higher = |best: Trial, thickness: f64| {
            let next = self.trial(stations, &options, thickness)?;
            Ok::<_, Error>(if value(&next) > value(&best) {
                next
            } else {
                best
            })
        };
        let mut best = first.clone();
        let mut thickness = FIRST * spacing;
        // Nothing lies deeper than the cloud is large, and all own points are the most that can be seen.
        while thickness > 0.0
            && thickness < 2.0 * self.bounds.diagonal()
            && value(&best) < ENOUGH - price(thickness, spacing)
        {
            best = higher(best, thickness)?;
            thickness *= 2.0;
        }
        let mut step: f64 = 2.0;
        for _ in 0..HALVINGS {
            step = square_root(step);
            let middle = best.thickness;
            if middle > 0.0 {
                best = higher(best, middle * step)?;
                best = higher(best, middle / step)?;
            }
        }
        Ok(best.compared_with(&first))
    }

    /// The points that take part in a view, by index, and which of them are a station's own.
    fn marks_of(&self, station: &Station, options: &Options) -> Result<Vec<Mark>, Error> {
        let part = self.part(Some(station.viewpoint), options)?;
        let mut marks: Vec<Mark> = filled(self.len(), Mark::Absent)?;
        for place in 0..part.sequence.points.len() {
            for &index in part.sequence.indices_of(place) {
                marks[index as usize] = Mark::Other;
            }
        }
        for &index in station.indices {
            let mark = marks
                .get_mut(index as usize)
                .ok_or(Error::IndexOutOfRange {
                    index,
                    len: self.len(),
                })?;
            if *mark == Mark::Other {
                *mark = Mark::Own;
            }
        }
        Ok(marks)
    }
}

/// What a point is to a station.
#[derive(Clone, Copy, PartialEq)]
enum Mark {
    /// It takes no part in the view.
    Absent,
    Own,
    Other,
}

impl PointCloud {
    fn trial(
        &self,
        stations: &[Station],
        options: &Options,
        thickness: f64,
    ) -> Result<Trial, Error> {
        let options = options.with_thickness(thickness);
        let mut recall = with_capacity(stations.len())?;
        let mut others = with_capacity(stations.len())?;
        for station in stations {
            let seen = self.visible_from(station.viewpoint, &options)?;
            let marks = self.marks_of(station, &options)?;
            let count = |mark| marks.iter().filter(|&&other| other == mark).count();
            let of_seen = |mark| {
                let seen = seen.indices().iter();
                seen.filter(|&&index| marks[index as usize] == mark).count()
            };
            let own = count(Mark::Own);
            recall.push(match own {
                0 => 1.0,
                _ => of_seen(Mark::Own) as f64 / own as f64,
            });
            others.push([of_seen(Mark::Other), count(Mark::Other)]);
        }
        Ok(Trial {
            thickness,
            recall,
            others,
        })
    }
}

impl Trial {
    /// What this thickness brings: own points, less hidden ones and less the price of the thickness.
    fn value(&self, first: &Self, spacing: f64) -> f64 {
        let mut wrong = 0.0;
        for (station, &[seen, all]) in self.others.iter().enumerate() {
            let share = |seen: usize| seen as f64 / all.max(1) as f64;
            let visible = share(first.others[station][0]) / first.recall[station];
            // The comparison also refuses a NaN.
            if visible < 1.0 {
                let more = share(seen) - visible * self.recall[station];
                wrong += larger(more / (1.0 - visible), 0.0);
            }
        }
        let wrong = wrong / self.others.len().max(1) as f64;
        mean(&self.recall, ENOUGH) - wrong - price(self.thickness, spacing)
    }

    fn compared_with(self, first: &Self) -> Calibration {
        let [mut hidden, mut more] = [0.0; 2];
        for (&[seen, _], &[before, all]) in self.others.iter().zip(&first.others) {
            hidden += (all - before) as f64;
            more += seen as f64 - before as f64;
        }
        Calibration {
            thickness: self.thickness,
            shown: if hidden > 0.0 {
                larger(more / hidden, 0.0)
            } else {
                0.0
            },
            recall: self.recall,
        }
    }
}

/// What a thickness must bring.
fn price(thickness: f64, spacing: f64) -> f64 {
    let thickness = thickness / larger(spacing, f64::MIN_POSITIVE);
    PRICE * libm::log2(1.0 + thickness / FIRST)
}

/// The mean of shares, each counted up to `most`.
fn mean(shares: &[f64], most: f64) -> f64 {
    let sum = shares.iter().map(|&share| smaller(share, most));
    sum.sum::<f64>() / shares.len().max(1) as f64
}
