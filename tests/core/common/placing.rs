//! Choices among viewpoints, without any shortcut.

pub fn weight_of(seen: &[bool], weights: &[f64]) -> f64 {
    let all = seen.iter().zip(weights);
    all.filter(|(seen, _)| **seen)
        .map(|(_, weight)| weight)
        .sum()
}

/// The greedy choice as the definition has it, without any shortcut.
pub fn eager(masks: &[Vec<bool>], weights: &[f64], count: usize) -> (Vec<usize>, Vec<f64>) {
    let mut seen = vec![false; weights.len()];
    let (mut chosen, mut gains) = (Vec::new(), Vec::new());
    while chosen.len() < count {
        let gain = |mask: &Vec<bool>| {
            let new: Vec<_> = mask
                .iter()
                .zip(&seen)
                .map(|(new, old)| *new && !old)
                .collect();
            weight_of(&new, weights)
        };
        let all: Vec<f64> = masks.iter().map(gain).collect();
        let most = all.iter().copied().fold(0.0, f64::max);
        if most == 0.0 {
            break;
        }
        let best = all.iter().position(|&gain| gain == most).unwrap();
        chosen.push(best);
        gains.push(most);
        seen.iter_mut()
            .zip(&masks[best])
            .for_each(|(seen, new)| *seen |= new);
    }
    (chosen, gains)
}

/// The largest weight that any choice of `count` candidates sees.
pub fn best(masks: &[Vec<bool>], weights: &[f64], count: usize) -> f64 {
    let choices = (0u32..1 << masks.len()).filter(|set| set.count_ones() as usize == count);
    let seen = choices.map(|set| {
        let sees = |index: usize| (0..masks.len()).any(|k| set >> k & 1 == 1 && masks[k][index]);
        let seen: Vec<bool> = (0..weights.len()).map(sees).collect();
        weight_of(&seen, weights)
    });
    seen.fold(0.0, f64::max)
}
