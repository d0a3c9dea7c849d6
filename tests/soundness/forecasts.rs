//! Forecasts for an experiment, from any quantities that are accepted.

use super::Seed;
use tristack::experiment::{
    ContactEstimate, Cylinder, Experiment, Forecast, density, length, modulus,
};

/// A forecast from the first quantities of every kind, one a line, where there are some.
pub fn check(data: &[u8]) {
    let lines = data.split(|&byte| byte == b'\n');
    let words: Vec<&str> = lines
        .filter_map(|line| std::str::from_utf8(line).ok())
        .collect();
    let first =
        |read: fn(&str) -> Result<f64, String>| words.iter().find_map(|word| read(word).ok());
    let (Some(youngs_modulus), Some(density)) = (first(modulus), first(density)) else {
        return;
    };
    let radius = first(length).unwrap_or(0.01);
    let numbers: Vec<f64> = words.iter().filter_map(|word| word.parse().ok()).collect();
    let number = |index: usize, otherwise: f64| numbers.get(index).copied().unwrap_or(otherwise);
    let cylinder = Cylinder {
        youngs_modulus,
        poisson_ratio: number(1, 0.5),
        density,
        radius,
        length: words
            .iter()
            .rev()
            .find_map(|word| length(word).ok())
            .unwrap_or(radius),
    };
    let experiment = Experiment {
        mu_uncertainty: number(2, 0.0),
        ..Experiment::new(cylinder, number(0, 0.3))
    };
    for estimate in ContactEstimate::ALL {
        if let Err(refusal) = Forecast::new(&experiment, estimate) {
            assert!(!refusal.to_string().is_empty());
        }
    }
}

pub fn seeds() -> Vec<Seed> {
    let experiments = [
        "1 MPa|1000 kg/m3|1 cm|40mm|0.3|0.5|0.05",
        "1 GPa|7.8 g/cm3|20 mm|0.04m|0.25|0.3|0.01",
        "200 GPa|2700 kg/m3|0.5 m|2 m|0.6|0.33|0",
    ];
    let seed = |(index, quantities): (usize, &str)| {
        let lines = quantities.replace('|', "\n");
        (format!("experiment-{index}"), lines.into_bytes())
    };
    experiments.into_iter().enumerate().map(seed).collect()
}
