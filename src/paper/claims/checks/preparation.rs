//! The preparation between side walls (supplement, I.B), by native runs.

use super::Check;
use crate::code::Code;
use crate::paper::claims::finding::{Finding, list, worst};
use crate::study::preparation::PreparationStudy;

pub(crate) const CHECKS: &[Check] = &[
    Check::runs("prepared-without-contact", |_, runs| {
        let mut without = 0;
        let mut listed = Vec::new();
        for study in &runs.preparation {
            without += usize::from(contact_forces(study).contains(&(0.0, Some(0.0))));
            if let Some(found) = study.critical_push {
                let push = found.push * study.stack.stiffness;
                listed.push(format!("{push:.4} epsilon r at {}", name(study)));
            }
        }
        let all = runs.preparation.len();
        if all == 0 {
            return Err(MISSING.to_owned());
        }
        let evidence = format!(
            "native runs of the protocol: c = 0 after it with A = 0 for {without} of {all} stacks, and up to A = {}",
            list(listed)
        );
        Ok(Finding::exceptions(all - without, evidence))
    }),
    Check::runs("push-controls-contact", |_, runs| {
        let mut wrong = 0;
        let mut listed = Vec::new();
        for study in &runs.preparation {
            let contacts = contact_forces(study).into_iter();
            let contacts = contacts.map(|(_, force)| force.unwrap_or(f64::NAN));
            let contacts: Vec<f64> = contacts.collect();
            let mut pairs = contacts.windows(2);
            let grows = pairs.all(|pair| pair[1] > pair[0] || pair == [0.0, 0.0]);
            let last = contacts.last().copied().unwrap_or(f64::NAN);
            wrong += usize::from(!(grows && last > 0.0));
            listed.push(format!("{last:.3} mg at {}", name(study)));
        }
        if runs.preparation.is_empty() {
            return Err(MISSING.to_owned());
        }
        let evidence = format!(
            "native runs of the protocol: c is 0 up to some A and grows with A beyond, to {} for the largest A (5 epsilon r)",
            list(listed)
        );
        Ok(Finding::exceptions(wrong, evidence))
    }),
    // Spread of the yield force over preparations that end with c = 0.
    Check::runs("no-contact-specifies", |_, runs| {
        let mut shifts = Vec::new();
        let mut listed = Vec::new();
        for study in &runs.preparation {
            let critical = study.critical_push;
            if let Some(shift) = critical.and_then(|found| study.shift(found.push)) {
                listed.push(format!("{:+.3} % at {}", 100.0 * shift, name(study)));
                shifts.push(shift.abs());
            }
        }
        if shifts.is_empty() {
            return Err(MISSING.to_owned());
        }
        let evidence = format!(
            "native runs of the protocol: between A = 0 and the largest A that also ends with c = 0, f + 3mg at yield changes by {}. The \
             tangential forces that A leaves are not fixed by c = 0",
            list(listed)
        );
        Ok(Finding::new(worst(shifts), 1e-4, evidence))
    }),
];

const MISSING: &str = "there is no native study of the preparation in this reproduction";

/// Pushes and the contact forces that they leave, natively under the paper's convention, sorted by push.
fn contact_forces(study: &PreparationStudy) -> Vec<(f64, Option<f64>)> {
    let rows = study.rows_of(Code::NATIVE, Code::NATIVE);
    let pushed = rows.filter_map(|row| Some((row.push?, row.contact_force)));
    let mut pushed: Vec<_> = pushed.collect();
    pushed.sort_by(|left, right| left.0.total_cmp(&right.0));
    pushed
}

fn name(study: &PreparationStudy) -> String {
    format!(
        "mu = {:.3}, k_n r/mg = {:e}",
        study.stack.floor_friction, study.stack.stiffness
    )
}
