//! The published numbers, reproduced by native runs of the authors' program.

use super::contradictions::{Contradiction, contradictions};
use super::points::{PublishedForce, PublishedSeries, published_forces, published_series};
use super::{Checkout, DataFile};
use crate::code::Code;
use crate::dem::{PublishedForces, PublishedRun};
use crate::runs::{RunError, Workload};
use crate::study::Campaign;
use serde::Serialize;

/// Largest difference, relative to F + 3, of a force that counts as reproduced although its last digits differ. The
/// published numbers are no more certain than that: two files of the authors, fig2a/data/k1e+2.txt and
/// src/data/k1.0e+02.txt, give the same runs up to 1.1e-6 apart, as do versions of a program that round differently,
/// for three bodies that start far from rest.
pub const ALIKE: f64 = 3e-6;

/// How well a published number is reproduced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fit {
    /// In every printed digit.
    EveryDigit,
    /// To [`ALIKE`] of F + 3.
    Alike,
    /// Worse than that.
    Differs,
    /// No start, speed and time step is known that gives it.
    Unknown,
    /// The run has failed.
    Failed,
}

/// A published force, and its reproduction.
#[derive(Debug, Clone)]
pub struct RepeatedForce {
    /// As it is published.
    pub published: PublishedForce,
    /// By a native run; `None` if no run is known that gives it.
    pub found: Option<Result<f64, RunError>>,
}

impl RepeatedForce {
    /// Returns the native force in m g.
    pub fn force(&self) -> Option<f64> {
        self.found.as_ref()?.as_ref().ok().copied()
    }

    /// Returns the native force less the published one, relative to F + 3.
    pub fn remainder(&self) -> Option<f64> {
        let value = self.published.value.value;
        self.force().map(|force| (force - value) / (value + 3.0))
    }

    /// Returns the published force less the exact limit, relative to the limit + 3.
    pub fn excess(&self) -> Option<f64> {
        let value = self.published.value.value;
        let limit = self.published.limit?;
        Some((value - limit) / (limit + 3.0))
    }

    /// Returns how well it is reproduced.
    pub fn fit(&self) -> Fit {
        match (&self.found, self.force(), self.remainder()) {
            (None, ..) => Fit::Unknown,
            (_, Some(force), _) if self.published.value.is(force) => Fit::EveryDigit,
            (.., Some(remainder)) if remainder.abs() <= ALIKE => Fit::Alike,
            (.., Some(_)) => Fit::Differs,
            _ => Fit::Failed,
        }
    }
}

/// A published series, and its reproduction.
#[derive(Debug, Clone)]
pub struct RepeatedSeries {
    /// As it is published.
    pub published: PublishedSeries,
    /// By a native run; `None` if no run is known that gives it.
    pub found: Option<Result<Vec<f64>, RunError>>,
}

impl RepeatedSeries {
    fn pairs(&self) -> impl Iterator<Item = (&super::Printed, f64)> {
        let found = self.found.iter().flatten().flatten().copied();
        self.published
            .rows
            .iter()
            .map(|(_, [_, force])| force)
            .zip(found)
    }

    /// Counts the rows that are reproduced in every printed digit.
    pub fn rows_in_every_digit(&self) -> usize {
        let same = self
            .pairs()
            .filter(|(published, found)| published.is(*found));
        same.count()
    }

    /// Returns the largest difference of a force, relative to |f| + 3.
    pub fn largest_remainder(&self) -> Option<f64> {
        let off = self.pairs().map(|(published, found)| {
            ((found - published.value) / (published.value.abs() + 3.0)).abs()
        });
        off.reduce(f64::max)
    }

    /// Returns how well it is reproduced.
    pub fn fit(&self) -> Fit {
        let rows = self.published.rows.len();
        match (&self.found, self.largest_remainder()) {
            (None, _) => Fit::Unknown,
            (Some(Ok(found)), Some(_)) if found.len() != rows => Fit::Failed,
            (_, Some(_)) if self.rows_in_every_digit() == rows => Fit::EveryDigit,
            (_, Some(remainder)) if remainder <= ALIKE => Fit::Alike,
            (_, Some(_)) => Fit::Differs,
            (_, None) => Fit::Failed,
        }
    }
}

/// A checkout, the reproductions of its numbers, and its contradictions.
#[derive(Debug, Clone)]
pub struct Published {
    /// The data files.
    pub files: Vec<DataFile>,
    /// The yield forces, file by file.
    pub forces: Vec<RepeatedForce>,
    /// The series of forces.
    pub series: Vec<RepeatedSeries>,
    /// Numbers for the same quantity that differ.
    pub contradictions: Vec<Contradiction>,
}

impl Published {
    /// Reproduces all numbers of `checkout` by native runs; returns `None` after an interrupt.
    pub fn repeat(checkout: &Checkout, campaign: &Campaign) -> Option<Self> {
        let (forces, series) = (published_forces(checkout), published_series(checkout));
        let contradictions = contradictions(checkout, &forces);
        let of_forces = forces.iter().filter_map(|force| force.origin.as_ref());
        let of_series = series.iter().filter_map(|series| series.origin.as_ref());
        let tasks: Vec<PublishedRun> = of_forces.chain(of_series).map(|own| own.run).collect();
        let workload = Workload {
            code: Code::native(),
            tasks,
        };
        let mut found = campaign
            .read_native::<PublishedForces>(&[workload])
            .into_iter()
            .flatten();
        let mut was_interrupted = false;
        let mut next = |has_origin: bool| {
            let own = if has_origin { found.next() } else { None };
            was_interrupted |= matches!(&own, Some(Err(error)) if error.is_interrupted());
            own
        };
        let forces = forces.into_iter().map(|published| RepeatedForce {
            found: next(published.origin.is_some()).map(|found| found.map(|own| force_of(&own))),
            published,
        });
        let forces: Vec<RepeatedForce> = forces.collect();
        let series = series.into_iter().map(|published| RepeatedSeries {
            found: next(published.origin.is_some()).map(|found| found.map(|own| own.samples)),
            published,
        });
        let series: Vec<RepeatedSeries> = series.collect();
        (!was_interrupted).then(|| Self {
            files: checkout.files.clone(),
            contradictions,
            forces,
            series,
        })
    }

    /// Returns the forces of a figure, by the name of its folder.
    pub fn of_figure(&self, figure: &str) -> impl Iterator<Item = &PublishedForce> {
        let forces = self.forces.iter().map(|own| &own.published);
        forces.filter(move |own| own.figure() == figure)
    }

    /// Returns how well each number is reproduced; a series counts as one.
    pub fn fits(&self) -> impl Iterator<Item = Fit> {
        let forces = self.forces.iter().map(RepeatedForce::fit);
        forces.chain(self.series.iter().map(RepeatedSeries::fit))
    }
}

/// Returns the force at which a run was stopped, or else that before the first decrease.
fn force_of(forces: &PublishedForces) -> f64 {
    let stopped = forces.samples.last().copied();
    stopped.or(forces.yield_force).unwrap_or(f64::NAN)
}
