//! The passport of a code: its convention as measured, what that changes in the yield force, and who shares it.

use super::finding::{Finding, TOLERANCE};
use super::measured::{Findings, contradicting};
use crate::code::{Code, ConventionKey, Settled};
use crate::model::{Arms, ContactConvention, DampingGrowth, Law, Material, Problem, Stack};
use crate::study::Verdict;
use crate::theory::{limit_uncertainty, quasistatic_limit};

/// Name and version of the format.
pub const PASSPORT: &str = "tristack/passport/1";

/// Frictions and stiffnesses of the stacks of a passport: below and above the critical friction, and stiff. Their stiffness
/// ratio is the usual one of the law.
const STACKS: [(f64, f64); 3] = [(0.2, 1e2), (0.3, 1e2), (0.3, 1e4)];

/// What a probe says about a code, for its author and for its readers.
#[derive(Debug, Clone)]
pub struct Passport<'a> {
    /// The code.
    pub code: Code,
    /// Everything that was measured.
    pub findings: &'a Findings,
    /// The keys of its convention.
    pub convention: Vec<MeasuredKey>,
    /// What its arms change.
    pub effects: Vec<ArmEffects>,
    /// The built-in codes with the same convention, within the uncertainty.
    pub twins: Vec<Code>,
    /// The built-in codes with the same arms, whose yield forces are the same.
    pub same_arms: Vec<Code>,
}

/// A key of a convention, as measured.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredKey {
    /// The key.
    pub key: ConventionKey,
    /// Its value as the motions show it; absent where they do not.
    pub measured: Option<String>,
    /// The uncertainty of a number.
    pub uncertainty: Option<f64>,
    /// Its value in the manifest; absent where that leaves it out.
    pub declared: Option<String>,
    /// The worst verdict on what was measured of it.
    pub verdict: Verdict,
}

/// What the arms of a code change in the yield force of one stack.
#[derive(Debug, Clone, PartialEq)]
pub struct ArmEffects {
    /// The stack.
    pub stack: Stack,
    /// The limit with the paper's arms, in m g.
    pub paper_force: Option<f64>,
    /// By how much each arm of the code alone changes it, in m g; absent where the arm is not known.
    pub changes: [Option<f64>; 4],
    /// The limit with all arms of the code, in m g; absent where one is not known.
    pub force: Option<f64>,
    /// Uncertainty of that limit from the uncertainties of the measured arms, in m g.
    pub uncertainty: Option<f64>,
    /// Why there is no such limit; absent if there is one.
    pub reason: Option<String>,
}

impl Passport<'_> {
    /// What its contacts do differently in long time steps.
    pub fn time_step_effects(&self) -> Vec<String> {
        let findings = self.findings.findings.iter();
        findings.filter_map(Finding::time_step_effect).collect()
    }

    /// The worst verdict on what was measured.
    pub fn verdict(&self) -> Verdict {
        let properties = self.findings.findings.iter().map(|own| own.verdict);
        let keys = self.convention.iter().map(|own| own.verdict);
        properties
            .chain(keys)
            .max()
            .unwrap_or(Verdict::Inconclusive)
    }
}

/// What does not agree in `findings`: properties that are not as declared, keys that are left out and not known, and
/// undeclared properties that could not be measured, with the reason.
pub fn reservations(findings: &Findings) -> Vec<String> {
    let unknown = findings.settled.unknown.iter();
    let unknown = unknown.map(|own| {
        let (key, because, matters) = (own.key, &own.because, own.matters());
        format!("{key} is left out and not known: {because}; {matters}")
    });
    let unseen = findings.findings.iter().filter_map(|own| {
        let because = own.unknown_because().filter(|_| own.declared.is_none())?;
        Some(format!("{} is unknown: {because}", own.property))
    });
    let contradicting = contradicting(findings).into_iter();
    contradicting.chain(unknown).chain(unseen).collect()
}

/// The passport of `code` from the `findings` of its probe.
pub fn passport<'a>(code: &Code, findings: &'a Findings) -> Passport<'a> {
    let measured = &findings.measured;
    let others = Code::with_power(code.law().power)
        .into_iter()
        .filter(|other| other.is_built_in() && !other.accepts_any_convention() && other != code);
    let alike = |keys: fn(ConventionKey) -> bool| -> Vec<Code> {
        let same = others.clone().filter(|other| {
            let declared = other.as_declared();
            has_same_limit(code, other)
                && declared.is_some_and(|other| {
                    let other = other.settled();
                    is_same(measured, other, keys)
                        && turns(measured).is_some_and(|own| turns(other) == Some(own))
                })
        });
        same.collect()
    };
    let damping = code.law().damping;
    Passport {
        code: code.clone(),
        findings,
        convention: ConventionKey::ALL
            .map(|key| measured_key(code, findings, key))
            .into(),
        effects: STACKS
            .map(|(friction, stiffness)| effects(Stack::paper(friction, stiffness), measured))
            .into(),
        twins: alike(|key| key != ConventionKey::VelocityLag)
            .into_iter()
            .filter(|other| other.law().damping == damping)
            .collect(),
        same_arms: alike(ConventionKey::moves_limit),
    }
}

/// Whether springs turn with their contacts, if that is known.
fn turns(settled: &Settled) -> Option<bool> {
    settled
        .knows_turning()
        .then(|| settled.convention.history_update.turns())
}

/// Whether two codes have the same limit: their laws differ in their damping at most.
fn has_same_limit(code: &Code, other: &Code) -> bool {
    let [own, theirs] = [code, other].map(|code| Law {
        damping: DampingGrowth::default(),
        ..code.law()
    });
    own == theirs
}

/// Whether `measured` agrees with the convention of the `other` code in all `keys`, within its uncertainty.
fn is_same(measured: &Settled, other: &Settled, keys: fn(ConventionKey) -> bool) -> bool {
    let mut keys = ConventionKey::ALL.into_iter().filter(|key| keys(*key));
    keys.all(|key| {
        let known = measured.reason(key).is_none() && other.reason(key).is_none();
        let numbers = measured.number(key).zip(other.number(key));
        known
            && match numbers {
                Some((own, theirs)) => {
                    (own - theirs).abs() <= measured.uncertainty(key).unwrap_or(0.0) + TOLERANCE
                }
                None => measured.value(key) == other.value(key),
            }
    })
}

fn measured_key(code: &Code, findings: &Findings, key: ConventionKey) -> MeasuredKey {
    let declaration = code.declaration();
    let declared = !declaration.left_out.contains(&key);
    let measured = &findings.measured;
    let own = findings.findings.iter().filter(|own| own.key == Some(key));
    let worst = own.map(|own| own.verdict).max();
    let known = measured.reason(key).is_none();
    MeasuredKey {
        key,
        measured: known.then(|| measured.value(key)),
        uncertainty: measured.uncertainty(key).filter(|_| known),
        declared: declared.then(|| declaration.unsettled("").value(key)),
        verdict: match worst {
            Some(verdict) if known || verdict == Verdict::Differs => verdict,
            _ => Verdict::Inconclusive,
        },
    }
}

fn effects(stack: Stack, measured: &Settled) -> ArmEffects {
    let law = measured.convention.law;
    let stack = Stack {
        stiffness_ratio: match law.is_linear() {
            true => stack.stiffness_ratio,
            false => Material::USUAL_STIFFNESS_RATIO,
        },
        ..stack
    };
    let limit = |arms: Arms| {
        let convention = ContactConvention {
            law,
            history_update: measured.convention.history_update,
            ..ContactConvention::with_arms(arms)
        };
        let problem = Problem::new(stack, convention).ok()?;
        Some(quasistatic_limit(&problem))
    };
    let force = |arms: Arms| limit(arms)?.yield_force;
    let arms = measured.convention.arms;
    let paper_force = force(Arms::PAPER);
    let known = |key: &ConventionKey| measured.reason(*key).is_none();
    let alone = |key: ConventionKey| {
        let mut one = Arms::PAPER;
        key.set_arm(&mut one, key.arm(&arms).filter(|_| known(&key))?);
        Some(force(one)? - paper_force?)
    };
    let all_known = measured.knows_limit();
    let own = Problem::new(stack, measured.convention).ok();
    let uncertainty = own.and_then(|own| limit_uncertainty(&own, &measured.arm_uncertainty));
    let own_limit = limit(arms).filter(|_| all_known);
    let reason = match &own_limit {
        Some(limit) => limit.reason.clone(),
        None => {
            Some("not known, since it depends on what is not known of the convention".to_owned())
        }
    };
    ArmEffects {
        stack,
        paper_force,
        changes: ConventionKey::ARMS.map(alone),
        force: own_limit.and_then(|limit| limit.yield_force),
        reason,
        uncertainty: uncertainty.filter(|_| all_known),
    }
}
