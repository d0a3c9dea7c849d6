//! The features of contacts, which a task names where they are on.

/// What contacts may do beyond pushing and damping along their normal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feature {
    /// A tangential spring and dashpot.
    Friction,
}

impl Feature {
    /// All features.
    pub const ALL: [Self; 1] = [Self::Friction];

    /// Its name in `features` of a task: lower-case letters and underscores, as in names of variables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Friction => "friction",
        }
    }

    /// What a contact does that has it, in terms of the parameters of a task.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Friction => {
                "a tangential spring and dashpot, or neither between rigid bodies; their force at most `cylinder_friction` times \
                 the normal force between bodies and `floor_friction` times that at the floor; on where either is above 0"
            }
        }
    }
}
