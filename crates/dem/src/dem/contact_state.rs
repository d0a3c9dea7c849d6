//! The state of a contact between steps, in lanes of which perhaps only some touch.

use super::body::Touch;
use super::contact::{Contact, ContactForce, ContactModel};
use super::geometry::{Geometry, Plane};
use super::real::{Composite, Real};

/// Memory and force of a contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactState<R: Real, Memory, G: Geometry<R> = Plane> {
    pub(super) memory: Memory,
    pub(super) force: ContactForce<R, G>,
    /// Whether any lane has touched since the last reset.
    loaded: bool,
}

impl<R: Real, Memory: Copy + Composite<R>, G: Geometry<R>> ContactState<R, Memory, G> {
    #[inline(always)]
    pub(super) fn initial<Model: ContactModel<R, G, Memory = Memory>>(
        model: &Model,
        number: R,
    ) -> Self {
        Self {
            memory: model.initial(number),
            force: ContactForce::none(number),
            loaded: false,
        }
    }

    /// Evaluates `contact` in the lanes where it `touches`. In the other lanes, the kept force is zero and the memory
    /// is that of a new contact.
    #[inline(always)]
    pub(super) fn evaluate<const KEEP: bool, Model: ContactModel<R, G, Memory = Memory>>(
        &mut self,
        model: &Model,
        contact: &Contact<R, G>,
        touches: Touch<R>,
    ) -> ContactForce<R, G> {
        let mut memory = self.memory;
        let force = model.evaluate(contact, &mut memory);
        let nothing = Self::initial(model, contact.overlap);
        self.memory = touches.choose(memory, nothing.memory);
        if KEEP {
            self.force = touches.choose(force, nothing.force);
        }
        self.loaded = true;
        force
    }

    #[inline(always)]
    pub(super) fn separate<const KEEP: bool, Model: ContactModel<R, G, Memory = Memory>>(
        &mut self,
        model: &Model,
        number: R,
    ) {
        if KEEP || self.loaded {
            *self = Self::initial(model, number);
        }
    }
}

impl<R: Real, Memory: Composite<R>, G: Geometry<R>> Composite<R> for ContactState<R, Memory, G> {
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        self.memory.visit(&other.memory, visit);
        self.force.visit(&other.force, visit);
        // The copied lane may be loaded; if it is not, the next step resets it.
        self.loaded = true;
    }
}

#[cfg(test)]
mod tests {
    use super::super::contact::{Spring, SpringDashpot};
    use super::*;
    use crate::dem::contact::tests::CONTACT as SLIDING;
    use crate::model::ContactConvention;

    type State = ContactState<f64, Spring<f64>>;

    const CONTACT: Contact<f64> = Contact {
        overlap: 0.5,
        friction: 10.0,
        ..SLIDING
    };

    fn law() -> SpringDashpot<f64> {
        SpringDashpot::like(1.0, &ContactConvention::TURNING, 2.5)
    }

    fn after_one_step(touches: Touch<f64>) -> State {
        let mut state = State::initial(&law(), 0.0);
        let force = state.evaluate::<true, _>(&law(), &CONTACT, touches);
        assert_eq!(force.normal, 0.5);
        state
    }

    #[test]
    fn what_touches_is_remembered_and_what_does_not_has_no_past() {
        for touches in [Touch::Everywhere, Touch::Where(true)] {
            let state = after_one_step(touches);
            assert_eq!((state.memory.length, state.force.normal), (0.05, 0.5));
        }
        let apart = after_one_step(Touch::Where(false));
        assert_eq!((apart.memory.length, apart.force.normal), (0.0, 0.0));
    }

    #[test]
    fn a_contact_that_separates_is_reset_whether_its_force_is_kept_or_not() {
        let mut state = after_one_step(Touch::Everywhere);
        state.separate::<false, _>(&law(), 0.0);
        assert_eq!((state.memory.length, state.loaded), (0.0, false));
        let mut state = after_one_step(Touch::Everywhere);
        state.separate::<true, _>(&law(), 0.0);
        assert_eq!((state.memory.length, state.force.normal), (0.0, 0.0));
        // A kept force must be that of this step, even if the memory had nothing to reset.
        let mut state = after_one_step(Touch::Everywhere);
        state.loaded = false;
        state.separate::<true, _>(&law(), 0.0);
        assert_eq!(state.force.normal, 0.0);
    }

    #[test]
    fn a_state_is_taken_over_with_memory_and_force() {
        let other = after_one_step(Touch::Everywhere);
        let mut state = State::initial(&law(), 0.0);
        state.visit(&other, &mut |own, other| *own = *other);
        assert_eq!((state.memory.length, state.force.normal), (0.05, 0.5));
        state.separate::<false, _>(&law(), 0.0);
        assert_eq!(state.memory.length, 0.0);
    }
}
