//! The tangential law of a contact that sticks: stiffness, damping, arms, history update.

use super::contact_frame::{ContactRow, as_long_as};
use super::finding::TOLERANCE;
use super::growth::{EXPLAINED, exponent};
use super::linear_form::{DAMPING, DAMPING_SPIN_OVERLAP, Form, SPRING, SPRING_SPIN};
use super::linear_form::{SPRING_SPIN_CUBED, SPRING_SPIN_OVERLAP};
use super::linear_form::{carried, cubed_turns, sticking, versine};
use super::regression::{Measured, fit};
use super::shape::Growth;
use super::spring_shape::SpringShape;

/// Rounds in which the transport and the other coefficients are fitted in turn; each gains some two digits.
const ROUNDS: usize = 8;

/// Largest change of a spring's length, in units of 1 − cos dψ, that is believed. No rule changes it by more than a few;
/// errors of first order in the time step look like thousands.
const LARGEST_TRANSPORT: f64 = 100.0;

/// f_t = −k_t u − η_t w, where the spring u grows by w dt a step and w = v_t − R ω, R = r + r₁ δ.
///
/// Codes differ from it in two ways that are looked for: k_t may grow with a power of the overlap, and a surface that
/// turns by d in a step may move by R (d + c d³). Where the normal force is not linear, η_t grows too, and more than a
/// displacement may be remembered ([`Form`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TangentialLaw {
    /// k_t; if it grows, at an overlap of 1.
    pub stiffness: Measured,
    /// The power of the overlap with which k_t grows, if it does beside a linear normal force.
    pub exponent: Option<Measured>,
    /// Growth and memory beside a normal force that is not linear.
    pub shape: Option<SpringShape>,
    /// η_t; if it grows, at an overlap of 1.
    pub damping: Measured,
    /// R at vanishing overlap, from the torque.
    pub radius: Measured,
    /// R at vanishing overlap, from the growth of the spring.
    pub spring_radius: Measured,
    /// r₁ from the torque.
    pub torque_arm: Measured,
    /// r₁ from the growth of the spring, in the limit of small steps.
    pub kinematic_arm: Measured,
    /// c, if it is not 0.
    pub third_order: Option<Measured>,
    /// r₁ from the damping.
    pub damping_arm: Measured,
    /// Change of the spring's length in units of 1 − cos dψ, when the contact turns by dψ.
    pub transport: Measured,
    /// Share of its normal component that the spring keeps when the contact turns, if it is seen
    /// ([`Form::left_behind`]).
    pub left_behind: Option<Measured>,
    /// Uncertainty of that share where it is not seen: infinite if it was not looked for.
    pub unseen_share: f64,
    /// Whether the normal force contains the normal component of a spring that is left behind.
    exerts_lift: bool,
    /// The form of the best fit.
    form: Form,
}

impl TangentialLaw {
    /// Fits several gentle motions and, for a pair, one in which the contact `turns`. The `refined` motions have half
    /// the time step; `stiffness` is the declared k_t.
    pub fn read(
        gentle: &[Vec<ContactRow>],
        refined: &[Vec<ContactRow>],
        turning: Option<&[ContactRow]>,
        stiffness: f64,
    ) -> Self {
        let [gentle, refined] = [gentle, refined].map(sticking_rows);
        let arms = arms_of_torque(&gentle);
        let small = small_turns(&gentle, &refined);
        let third_order = has_third_order(&small, arms.0.value);
        let motions = if third_order { small } else { gentle };
        let form = Form {
            third_order,
            ..Form::PLAIN
        };
        let mut law = Self::fitted(&motions, form, None, arms);
        if let Some(power) = law.growth(&motions, form, stiffness) {
            law = Self::fitted(&motions, form, Some(power), arms);
        }
        let Some(turning) = turning else {
            return law;
        };
        if third_order {
            // Where a contact turns far in a step, another term of third order may hold.
            let transport = form.fit_transport(&motions, arms.0.value);
            return law.with_transport(transport, &motions, form, arms);
        }
        for _ in 0..ROUNDS {
            let transport = law.fit_transport(sticking(turning));
            law = law.with_transport(transport, &motions, form, arms);
        }
        if law.transport.value.abs() > LARGEST_TRANSPORT {
            let none = law.with_transport(Measured::new(0.0, 0.0), &motions, form, arms);
            law = Self {
                transport: law.transport,
                ..none
            };
        }
        let turned: Vec<&[ContactRow]> =
            motions.iter().copied().chain([sticking(turning)]).collect();
        law.or_left_behind(&turned, ROUNDS, |form| {
            Self::fitted(&motions, form, law.exponent, arms)
        })
    }

    /// Returns this law, or one with a spring of which a share is left behind, if that explains in the `motions` what
    /// a spring that follows its contact cannot. `fitted` gives the law of a form. Any share is searched for in this
    /// many `rounds`; with none, the spring is left behind wholly or not at all.
    fn or_left_behind(
        self,
        motions: &[&[ContactRow]],
        rounds: usize,
        fitted: impl Fn(Form) -> Self,
    ) -> Self {
        let radius = self.radius.value;
        let left = |form: Form| {
            let left = form.deviations(motions, radius);
            left.map_or(f64::INFINITY, |(mean, _)| mean)
        };
        let without = left(self.form);
        let explains = |form: Form| left(form) < EXPLAINED * without;
        let forces = motions.iter().copied().flatten();
        let squares = forces.map(|row| row.tangential_force * row.tangential_force);
        let count = motions.iter().map(|rows| rows.len()).sum::<usize>() as f64;
        let mean = squares.sum::<f64>() / count;
        let is_exact = |form: Form| left(form) < TOLERANCE * TOLERANCE * mean;
        let is_seen = |share: Measured| share.value.abs() > share.uncertainty.max(TOLERANCE);
        let mut law = fitted(self.form.fixed());
        let nothing_turns_it = explains(law.form);
        let mut turning = law.form.fit_turning(motions, radius);
        for _ in 0..rounds {
            if explains(law.form) || !is_seen(turning[1]) {
                break;
            }
            law = fitted(law.form.with_turning(turning));
            turning = law.form.fit_turning(motions, radius);
        }
        let [transport, left_behind] = turning;
        let is_share = explains(law.form) && is_exact(law.form) && is_seen(left_behind);
        match nothing_turns_it || is_share {
            true => Self {
                transport,
                left_behind: Some(left_behind),
                ..law
            },
            false => Self {
                unseen_share: left_behind.value.abs() + left_behind.uncertainty,
                ..self
            },
        }
    }

    /// Like [`Self::read`], beside a normal force that is not linear and whose stiffness has the growth `normal`.
    pub fn read_growing(
        gentle: &[Vec<ContactRow>],
        refined: &[Vec<ContactRow>],
        turning: Option<&[ContactRow]>,
        normal: Growth,
    ) -> Self {
        let [gentle, refined] = [gentle, refined].map(sticking_rows);
        let (radius, arm) = arms_of_torque(&gentle);
        let motions = small_turns(&gentle, &refined);
        let fitted = |form: Form, motions: &[&[ContactRow]]| {
            let (shape, coefficients, form) = SpringShape::fit(form, motions, radius.value);
            let law = Self::of_coefficients(&coefficients, form, (radius, arm));
            Self {
                shape: Some(shape),
                transport: shape.transport,
                ..law
            }
        };
        let start = SpringShape::start(normal, &motions, radius.value);
        let cubed = Form {
            third_order: true,
            ..start
        };
        let (law, further) = (fitted(start, &motions), fitted(cubed, &motions));
        let left = |law: &Self| Some(law.form.deviations(&motions, radius.value)?.0);
        let explains = left(&further).zip(left(&law));
        if explains.is_some_and(|(with, without)| with < EXPLAINED * without) {
            // Where a contact turns far in a step, another term of third order may hold.
            let transport = further.form.fit_transport(&motions, radius.value);
            return Self {
                transport,
                ..further
            };
        }
        let turning = turning.map(sticking).into_iter();
        let all: Vec<&[ContactRow]> = motions.iter().copied().chain(turning).collect();
        // Growth and memory would absorb a share that is left behind, so that it is all or nothing.
        fitted(law.form, &all).or_left_behind(&all, 0, |form| fitted(form, &all))
    }

    /// The law of the same form that fits with `transport`.
    fn with_transport(
        &self,
        transport: Measured,
        motions: &[&[ContactRow]],
        form: Form,
        arms: (Measured, Measured),
    ) -> Self {
        let form = Form {
            transport: transport.value,
            ..form
        };
        Self {
            transport,
            ..Self::fitted(motions, form, self.exponent, arms)
        }
    }

    /// Fits a law of the given form to `motions`; `exponent` replaces that of the form.
    fn fitted(
        motions: &[&[ContactRow]],
        form: Form,
        exponent: Option<Measured>,
        (radius, torque_arm): (Measured, Measured),
    ) -> Self {
        let form = form.with_exponent(exponent.map_or(0.0, |power| power.value));
        let found = form.fit(motions, radius.value);
        Self {
            exponent,
            ..Self::of_coefficients(&found, form, (radius, torque_arm))
        }
    }

    /// The law with the coefficients `found` of a form.
    fn of_coefficients(
        found: &[Measured],
        form: Form,
        (radius, torque_arm): (Measured, Measured),
    ) -> Self {
        let third_order = || found[SPRING_SPIN_CUBED].over(found[SPRING_SPIN]);
        Self {
            stiffness: found[SPRING],
            exponent: None,
            shape: None,
            form,
            damping: found[DAMPING],
            radius,
            spring_radius: found[SPRING_SPIN].over(found[SPRING]),
            torque_arm,
            kinematic_arm: found[SPRING_SPIN_OVERLAP].over(found[SPRING]),
            third_order: form.third_order.then(third_order),
            damping_arm: found[DAMPING_SPIN_OVERLAP].over(found[DAMPING]),
            transport: Measured::new(0.0, 0.0),
            left_behind: None,
            unseen_share: f64::INFINITY,
            exerts_lift: true,
        }
        .with_common_radius()
    }

    /// Adds a small difference between the radius of the spring and that of the torque, which should be the same, to the
    /// uncertainty of the latter.
    fn with_common_radius(mut self) -> Self {
        let apart = radii_apart(self.radius, self.spring_radius);
        self.radius.uncertainty += if apart > TOLERANCE {
            0.0
        } else {
            apart.max(0.0)
        };
        self
    }

    /// The exponent with which k_t grows with the overlap, if it does and k_t is not the declared `stiffness`.
    fn growth(&self, motions: &[&[ContactRow]], form: Form, stiffness: f64) -> Option<Measured> {
        let Measured { value, uncertainty } = self.stiffness;
        if (value - stiffness).abs().max(uncertainty) <= TOLERANCE * stiffness {
            return None;
        }
        let radius = self.radius.value;
        let found = exponent(|exponent| form.with_exponent(exponent).deviations(motions, radius))?;
        let form = form.with_exponent(found.value);
        Some(form.fit_exponent(motions, radius))
    }

    fn radius_at(&self, row: &ContactRow) -> f64 {
        self.radius.value + self.kinematic_arm.value * row.overlap
    }

    /// w of a row.
    pub fn surface_speed(&self, row: &ContactRow) -> f64 {
        row.tangential_speed - self.radius_at(row) * row.spin()
    }

    /// The growth of the spring in the step that leads to a row.
    pub fn spring_growth(&self, row: &ContactRow) -> f64 {
        let third_order = self.third_order.map_or(0.0, |own| own.value);
        let further = third_order * self.radius_at(row) * cubed_turns(row);
        self.surface_speed(row) * row.time_step - further
    }

    /// k_t at an overlap.
    pub fn stiffness_at(&self, overlap: f64) -> f64 {
        self.stiffness.value * self.form.stiffness.at(overlap)
    }

    /// η_t at the overlap of a row.
    pub fn damping_at(&self, row: &ContactRow) -> f64 {
        self.damping.value * self.form.damping.at(row.overlap)
    }

    /// Force of the spring, −k_t u, in a row that sticks.
    pub fn spring_force(&self, row: &ContactRow) -> f64 {
        row.tangential_force + self.damping_at(row) * self.surface_speed(row)
    }

    /// What a spring with this `force` remembers in a row; for a constant stiffness, its length.
    pub fn length(&self, row: &ContactRow, force: f64) -> f64 {
        -force / (self.stiffness.value * self.form.exerted(row))
    }

    /// The growth of that length in the step that leads to a row.
    pub fn growth_of_length(&self, row: &ContactRow) -> f64 {
        self.spring_growth(row) * self.form.remembered(row)
    }

    /// Tangential and normal components of that length, after the contact has turned between two rows.
    pub fn turned(&self, length: [f64; 2], before: &ContactRow, row: &ContactRow) -> [f64; 2] {
        self.form.turned(length, before, row)
    }

    /// Whether the spring is left behind, so that its force has a part along the normal.
    pub fn lifts(&self) -> bool {
        self.left_behind.is_some() && self.exerts_lift
    }

    /// This law with a normal force that contains nothing of the spring.
    pub fn without_lift(self) -> Self {
        Self {
            exerts_lift: false,
            ..self
        }
    }

    /// This law without damping, as it is in a motion with a restitution of 1.
    pub fn undamped(self) -> Self {
        Self {
            damping: Measured::new(0.0, 0.0),
            ..self
        }
    }

    /// `rows` of a contact that sticks, with the normal component of the force of its spring as their lift.
    pub fn with_lift(&self, rows: &[ContactRow]) -> Vec<ContactRow> {
        if !self.lifts() {
            return rows.to_vec();
        }
        let length = |row: &ContactRow| self.length(row, self.spring_force(row));
        let mut last: Option<(&ContactRow, f64)> = None;
        let lifted = rows.iter().map(|row| {
            let [_, along_normal] = match last {
                Some((before, along_normal)) => {
                    self.turned([length(before), along_normal], before, row)
                }
                None => {
                    let start = length(row) - self.growth_of_length(row);
                    self.form.begun(row).map(|part| start * part)
                }
            };
            last = Some((row, along_normal));
            row.lifted_by(-self.stiffness.value * self.form.exerted(row) * along_normal)
        });
        lifted.collect()
    }

    /// Relative uncertainty of such a length from that of its coefficients.
    pub fn open_share(&self) -> f64 {
        self.stiffness.uncertainty / self.stiffness.value
            + self.damping.uncertainty / self.damping.value
            + self.shape.map_or(0.0, |shape| shape.uncertainty())
    }

    /// Fits the transport to one motion with a stretched spring, all other coefficients being known, by Gauss–Newton
    /// in the transport and the initial spring.
    fn fit_transport(&self, rows: &[ContactRow]) -> Measured {
        let Some(first) = rows.first() else {
            return Measured::UNKNOWN;
        };
        let (mut initial, mut transport) = (
            self.spring_force(first) / self.form.exerted(first),
            self.transport.value,
        );
        let mut found = Measured::UNKNOWN;
        for _ in 0..ROUNDS {
            let (mut spring, mut by_initial, mut by_transport) = (initial, 1.0, 0.0);
            let mut terms = Vec::new();
            for window in rows.windows(2) {
                let [before, row] = [&window[0], &window[1]];
                let factor = carried(before, row, transport);
                by_transport = by_transport * factor + versine(before, row) * spring;
                by_initial *= factor;
                spring = spring * factor - self.stiffness.value * self.growth_of_length(row);
                let stiffer = self.form.exerted(row);
                let by = [by_initial, by_transport].map(|by| by * stiffer);
                terms.push((by, self.spring_force(row) - spring * stiffer));
            }
            let [start, change] = fit(&terms);
            initial += start.value;
            transport += change.value;
            found = Measured::new(transport, change.uncertainty);
        }
        found
    }
}

fn sticking_rows(motions: &[Vec<ContactRow>]) -> Vec<&[ContactRow]> {
    motions.iter().map(|rows| sticking(rows)).collect()
}

/// The `gentle` motions as long as nothing turns by more in a step than in the `refined` ones, followed by these.
/// Codes may compute large turns differently from small ones, and the arm is that of small ones.
fn small_turns<'a>(
    gentle: &[&'a [ContactRow]],
    refined: &[&'a [ContactRow]],
) -> Vec<&'a [ContactRow]> {
    let turns = refined.iter().copied().flatten().map(ContactRow::turn);
    let largest = turns.fold(0.0, f64::max);
    let small = gentle
        .iter()
        .map(|rows| as_long_as(rows, |row| row.turn() <= largest));
    let small = small.filter(|rows| !rows.is_empty());
    small.chain(refined.iter().copied()).collect()
}

/// Whether a term of third order in the turn of a step explains the deviations that a law without it leaves, in
/// motions with two time steps. It fades with the square of the step, unlike a term of third order in the spin.
fn has_third_order(motions: &[&[ContactRow]], radius: f64) -> bool {
    let left = |third_order| {
        let form = Form {
            third_order,
            ..Form::PLAIN
        };
        Some(form.deviations(motions, radius)?.0)
    };
    let (with, without) = (left(true), left(false));
    with.zip(without)
        .is_some_and(|(with, without)| with < EXPLAINED * without)
}

/// The difference of two radii less the uncertainty of the second one.
pub fn radii_apart(of_torque: Measured, of_spring: Measured) -> f64 {
    (of_spring.value - of_torque.value).abs() - of_spring.uncertainty
}

/// R at vanishing overlap and r₁ from −M = (R(0) + r₁ δ) f_t, of both bodies where both feel it.
fn arms_of_torque(gentle: &[&[ContactRow]]) -> (Measured, Measured) {
    let mut terms = Vec::new();
    for row in gentle.iter().copied().flatten() {
        let force = row.tangential_force;
        for torque in [row.torque, row.other_torque] {
            if torque != 0.0 {
                terms.push(([force, row.overlap * force], -torque));
            }
        }
    }
    let [radius, arm] = fit(&terms);
    (radius, arm)
}
