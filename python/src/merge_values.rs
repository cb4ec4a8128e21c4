//! One value from those of several cameras, in rows of one number for each channel.

/// How the values become one.
#[derive(Clone, Copy, PartialEq)]
pub enum Merge {
    Median,
    Mean,
    Vote,
    Best,
}

impl Merge {
    pub const WORDS: [(&str, Self); 4] = [
        ("median", Self::Median),
        ("mean", Self::Mean),
        ("vote", Self::Vote),
        ("best", Self::Best),
    ];
}

/// Merges as many rows as there are weights: at least one.
pub fn merged(merge: Merge, rows: &[f64], weights: &[f64], target: &mut [f32]) {
    let channels = target.len();
    let row = |number: usize| &rows[number * channels..][..channels];
    let chosen = match merge {
        Merge::Best => highest(weights),
        Merge::Vote => highest(&votes(row, weights)),
        Merge::Median | Merge::Mean => {
            for (channel, to) in target.iter_mut().enumerate() {
                let value = |number: usize| row(number)[channel];
                let average = if merge == Merge::Mean {
                    mean(value, weights)
                } else {
                    median(value, weights)
                };
                *to = average as f32;
            }
            return;
        }
    };
    for (to, value) in target.iter_mut().zip(row(chosen)) {
        *to = *value as f32;
    }
}

/// The first of the highest weights.
fn highest(weights: &[f64]) -> usize {
    let higher = |best: usize, k: usize| if weights[k] > weights[best] { k } else { best };
    (0..weights.len()).fold(0, higher)
}

/// The weights of equal rows together, at the first of them.
fn votes<'a>(row: impl Fn(usize) -> &'a [f64], weights: &[f64]) -> Vec<f64> {
    let mut votes = vec![0.0; weights.len()];
    for (k, weight) in weights.iter().enumerate() {
        let first = (0..k).find(|&first| row(first) == row(k)).unwrap_or(k);
        votes[first] += weight;
    }
    votes
}

fn mean(value: impl Fn(usize) -> f64, weights: &[f64]) -> f64 {
    let (mut sum, mut total) = (0.0, 0.0);
    for (k, weight) in weights.iter().enumerate() {
        sum += weight * value(k);
        total += weight;
    }
    // All scores may be 0.
    if total > 0.0 { sum / total } else { value(0) }
}

/// The value at which half of the weight is reached; between two values if it is reached exactly there.
fn median(value: impl Fn(usize) -> f64, weights: &[f64]) -> f64 {
    let mut order: Vec<usize> = (0..weights.len()).collect();
    order.sort_by(|&a, &b| value(a).total_cmp(&value(b)));
    let half = order.iter().fold(0.0, |sum, &k| sum + weights[k]) / 2.0;
    let mut sum = 0.0;
    for (at, &k) in order.iter().enumerate() {
        sum += weights[k];
        if sum > half || at + 1 == order.len() {
            return value(k);
        }
        if sum == half {
            return (value(k) + value(order[at + 1])) / 2.0;
        }
    }
    f64::NAN
}
