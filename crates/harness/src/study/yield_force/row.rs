//! The numbers of a row, under their names in tables.

use super::extrapolate::Extrapolation;
use super::judgement::Judgement;
use super::runs::Method;
use crate::code::KnownConvention;
use crate::model::Law;
use crate::runs::RunSummary;
use crate::study::Verdict;
use crate::theory::Limit;

impl Judgement {
    /// Floor friction μ.
    pub fn mu(&self) -> f64 {
        self.study.stack.floor_friction
    }

    /// Stiffness 1/ε; infinite where bodies are rigid.
    pub fn stiffness(&self) -> f64 {
        self.study.stack.stiffness
    }

    /// The exact limit under the convention of the code; `None` if an arm, or whether springs turn, is not known, so that
    /// no limit is known for it.
    fn known_limit(&self) -> Option<&Limit> {
        let knows = self.study.code.settled().knows_limit();
        knows.then_some(&self.study.limit)
    }

    /// What is known of the convention under which the limit was computed.
    pub fn known_convention(&self) -> KnownConvention {
        let settled = self.study.code.settled();
        match self.study.method {
            Method::Rigid => KnownConvention::NONE,
            _ => settled.known(&self.study.convention),
        }
    }

    /// The contact law; `None` where bodies are rigid.
    pub fn known_law(&self) -> Option<Law> {
        (self.study.method != Method::Rigid).then_some(self.study.convention.law)
    }

    /// Distance of the limit under the convention of the code from the one under the paper's, relative to F + 3.
    pub fn model_form(&self) -> Option<f64> {
        self.known_limit()?;
        self.study.model_form
    }

    /// F at vanishing wall speed, in m g.
    pub fn yield_force(&self) -> Option<f64> {
        self.finding.as_ref()?.force.map(|(force, _)| force)
    }

    /// Its uncertainty in m g.
    pub fn uncertainty(&self) -> Option<f64> {
        self.finding
            .as_ref()?
            .force
            .map(|(_, uncertainty)| uncertainty)
    }

    /// The exact yield force under the convention of the code, in m g.
    pub fn reference_force(&self) -> Option<f64> {
        self.known_limit()?.yield_force
    }

    /// The exact slip onset under the convention of the code, in m g.
    pub fn reference_onset(&self) -> Option<f64> {
        self.known_limit()?.slip_onset
    }

    /// The exact force by which the code is judged, in m g: the slip onset if there is one under the wall.
    pub fn judged_reference(&self) -> Option<f64> {
        let limit = self.known_limit()?;
        limit
            .yield_force
            .and(limit.slip_onset.or(limit.yield_force))
    }

    /// Whether the row is as it should be: it agrees, or there is no yield where theory expects none. A code whose
    /// convention is contradicted by its probe is not.
    pub fn passes(&self) -> bool {
        let is_expected = match self.verdict() {
            Verdict::Agrees => true,
            Verdict::NoYield => self.study.limit.yield_force.is_none(),
            _ => false,
        };
        is_expected && !self.grounds.is_contradicted()
    }

    /// (slip onset − exact onset)/(exact onset + 3), or the same for the peak if that is judged; `None` if nothing is
    /// judged.
    pub fn error(&self) -> Option<f64> {
        self.grounds.deviation().map(|(error, _)| error)
    }

    /// Largest error that agrees; `None` where nothing is judged.
    pub fn tolerance(&self) -> Option<f64> {
        self.grounds.deviation().map(|(_, tolerance)| tolerance)
    }

    /// The summary of each run, in the order of the cases; empty if one of them is missing.
    pub fn runs(&self) -> &[RunSummary] {
        self.finding.as_ref().map_or(&[], |finding| &finding.runs)
    }

    /// The slip onset at vanishing wall speed.
    pub fn slip(&self) -> Option<&Extrapolation> {
        self.finding.as_ref()?.slip.as_ref()
    }

    /// The peak at vanishing wall speed, with its uncertainty in m g.
    pub fn peak(&self) -> Option<(f64, f64)> {
        let finding = self.finding.as_ref()?;
        Some((finding.peak?.force, finding.peak_uncertainty?))
    }
}
