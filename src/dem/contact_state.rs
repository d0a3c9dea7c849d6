//! A contact from one step to the next, in lanes of which perhaps only some touch.

use super::contact::{Contact, ContactForce, ContactModel};
use super::real::{Composite, LaneWise, Real};

/// What a contact remembers and exerts.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactState<R, Memory> {
    memory: Memory,
    pub(super) force: ContactForce<R>,
    /// Whether any lane has touched since it was last forgotten.
    loaded: bool,
}

impl<R: Real, Memory: Copy + LaneWise<R>> ContactState<R, Memory> {
    #[inline(always)]
    pub(super) fn forgotten<Model: ContactModel<R, Memory = Memory>>(
        model: &Model,
        number: R,
    ) -> Self {
        Self {
            memory: model.forgotten(number),
            force: ContactForce::none(number),
            loaded: false,
        }
    }

    /// The force of `contact` where it `touches`; elsewhere it is without force and past.
    #[inline(always)]
    pub(super) fn evaluate<const KEEP: bool, Model: ContactModel<R, Memory = Memory>>(
        &mut self,
        model: &Model,
        contact: &Contact<R>,
        touches: Touch<R>,
    ) -> ContactForce<R> {
        let mut memory = self.memory;
        let force = model.evaluate(contact, &mut memory);
        let nothing = Self::forgotten(model, contact.overlap);
        self.memory = touches.choose(memory, nothing.memory);
        if KEEP {
            self.force = touches.choose(force, nothing.force);
        }
        self.loaded = true;
        force
    }

    #[inline(always)]
    pub(super) fn part<const KEEP: bool, Model: ContactModel<R, Memory = Memory>>(
        &mut self,
        model: &Model,
        number: R,
    ) {
        if KEEP || self.loaded {
            *self = Self::forgotten(model, number);
        }
    }
}

/// Where two bodies touch.
#[derive(Clone, Copy)]
pub(super) enum Touch<R: Real> {
    Everywhere,
    Where(R::Mask),
}

impl<R: Real> Touch<R> {
    #[inline(always)]
    pub(super) fn choose<C: LaneWise<R>>(self, yes: C, no: C) -> C {
        match self {
            Self::Everywhere => yes,
            Self::Where(mask) => C::choose(mask, yes, no),
        }
    }
}

impl<R: Real, Memory: Composite<R>> Composite<R> for ContactState<R, Memory> {
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        self.memory.visit(&other.memory, visit);
        self.force.visit(&other.force, visit);
        // Perhaps; what does not touch is forgotten in the next step.
        self.loaded = true;
    }
}
