//! Event runs: taken from the store, or carried out on all cores and kept.

use super::parallel::in_parallel;
use super::{Progress, Settings};
use crate::dem::{EventRun, Observation};
use crate::model::shown;
use std::time::Instant;

/// Estimated duration of a step in seconds.
const SECONDS_PER_STEP: f64 = 5e-8;

/// The observations of `runs`, in their order: from the store, or made now and kept there. Runs that an interrupt or
/// the time limit cuts short are incomplete.
pub(crate) fn observe_all(
    runs: &[EventRun],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Observation> {
    let stored = in_parallel(runs, settings.threads, |run| {
        stored(run, settings, progress)
    });
    let requests: Vec<(&EventRun, Option<Observation>)> = runs.iter().zip(stored).collect();
    let open = requests.iter().filter(|(_, stored)| stored.is_none());
    let work: Vec<f64> = open.map(|(run, _)| seconds(run)).collect();
    progress.planned(runs.len(), runs.len() - work.len(), work.iter().sum());
    in_parallel(&requests, settings.threads, |(run, stored)| {
        stored.unwrap_or_else(|| made(run, settings, progress))
    })
}

fn seconds(run: &EventRun) -> f64 {
    SECONDS_PER_STEP * run.largest_steps()
}

/// The observation of `run` in the store. A damaged one is put into quarantine.
fn stored(run: &EventRun, settings: &Settings, progress: &dyn Progress) -> Option<Observation> {
    if settings.fresh {
        return None;
    }
    let error = match settings.store.observation(run) {
        Ok(found) => return found,
        Err(error) => error,
    };
    let place = match settings.store.put_aside(&run.address()) {
        Ok(place) => format!("it is now {}", shown(&place)),
        Err(error) => error.to_string(),
    };
    let message = format!("damaged observation in the store, made anew: {error}; {place}");
    progress.warn(&message);
    None
}

/// Carries out `run`, and keeps the observation if the run is complete.
fn made(run: &EventRun, settings: &Settings, progress: &dyn Progress) -> Observation {
    if settings.interrupt.requested() {
        return Observation::NOTHING;
    }
    let start = Instant::now();
    let in_time = || {
        let limit = settings.time_limit;
        limit.is_none_or(|limit| start.elapsed() <= limit)
    };
    let observation = run.observe(|| !settings.interrupt.requested() && in_time());
    if observation.is_usable()
        && let Err(error) = settings.store.put_observation(run, &observation)
    {
        progress.warn(&format!("an observation could not be kept: {error}"));
    }
    progress.advanced(seconds(run));
    observation
}
