//! `tristack predict`.

use super::options::{FRICTION, Format, Friction, StackOptions, as_flag, number, single};
use super::{CliError, ExitStatus};
use crate::experiment::{
    ContactEstimate, Cylinder, Experiment, Forecast, density, length, mass, modulus,
};
use crate::model::Power;
use crate::output::{forecast_text, forecasts};
use clap::{ArgGroup, Args, ValueEnum};

/// Predict ε, regime and yield force of real cylinders, in SI units
#[derive(Debug, Args)]
#[command(
    group(ArgGroup::new("heaviness").required(true).args(["density", "mass"])),
    after_help = "Example: tristack predict --youngs \"1 MPa\" --density \"1000 kg/m3\" --radius \"1 cm\" \
    --length \"1 cm\" --mu 0.3\n\n\
    The normal stiffness k_n of a real contact is rarely known, so three estimates are given side by side:\n\n  \
    paper-scaling  the paper's epsilon = L rho g/E, here with L = r, that is k_n = pi E l: its order of\n                 \
    magnitude, on the stiff side\n  \
    line-contact   k_n = (pi/4) E* l with E* = E/(2 (1 - nu^2)), the straight line through Hertz's law\n  \
    hertz          Hertz's law of two parallel cylinders, logarithm included, as secant at the yield\n\n\
    The paper's examples use m = rho L^3 and f = m g/epsilon, together f = E L^2. Its elastomer (1 MPa, \
    1000 kg/m3, L = 1 cm) weighs 1 g, has epsilon = 1e-4 and f = 100 N:\n\n  \
    tristack predict --youngs \"1 MPa\" --mass \"1 g\" --radius \"1 cm\" --length \"3.183 mm\" --mu 0.3\n\n\
    Its wood of the same mass, f = 1e5 N, follows with E of 1 GPa, which is wood across the grain; the \
    paper does not give E, and 10 GPa (along the grain) would mean 1e6 N. Both lack the factor 2 G(mu) of the \
    exact limit. The wooden cylinders of its movies:\n\n  \
    tristack predict --youngs \"1 GPa\" --mass \"21.9 g\" --radius \"20 mm\" --length \"40 mm\" --poisson 0.3 --mu 0.3"
)]
pub(super) struct Arguments {
    /// Young's modulus with unit, such as "1 MPa"; for wood, across the grain
    #[arg(long, value_name = "E", value_parser = modulus, allow_hyphen_values = true)]
    youngs: f64,
    /// Density with unit, such as "1000 kg/m3" or "1 g/cm3"
    #[arg(long, value_name = "RHO", value_parser = density, allow_hyphen_values = true)]
    density: Option<f64>,
    /// Mass of a cylinder with unit, such as "21.9 g", instead of its density
    #[arg(long, value_name = "M", value_parser = mass, allow_hyphen_values = true)]
    mass: Option<f64>,
    /// Radius with unit, such as "1 cm"
    #[arg(long, value_name = "R", value_parser = length, allow_hyphen_values = true)]
    radius: f64,
    /// Length along the axis with unit, such as "40 mm"
    #[arg(long, value_name = "L", value_parser = length, allow_hyphen_values = true)]
    length: f64,
    #[arg(long, help = FRICTION, value_parser = single::<Friction>)]
    mu: Friction,
    /// Uncertainty of the floor friction, as ±
    #[arg(
        long,
        value_name = "U",
        default_value_t = 0.0,
        value_parser = number
    )]
    mu_uncertainty: f64,
    /// Poisson's ratio: 0.5 for rubber, about 0.3 for wood and metals; paper-scaling does not use it
    #[arg(
        long,
        value_name = "NU",
        default_value_t = 0.5,
        value_parser = number
    )]
    poisson: f64,
    /// Estimate of the contact stiffness to conclude from
    #[arg(long, value_enum, default_value_t = Estimate::PaperScaling)]
    contact: Estimate,
    #[command(flatten)]
    stack: StackOptions,
    /// Format of the result
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// A [`ContactEstimate`] on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Estimate {
    /// The paper's ε = L ρ g/E with L = r, that is k_n = π E l. An order of magnitude, and on the
    /// stiff side of it
    PaperScaling,
    /// k_n = (π/4) E* l, the straight line through Hertz's law (V. L. Popov, *Contact Mechanics and Friction*,
    /// section 5.6): what DEM codes use in two dimensions. Independent of radius and load
    LineContact,
    /// The secant of Hertz's law, logarithm included, at the overlap at which the stack yields
    Hertz,
}

impl From<Estimate> for ContactEstimate {
    fn from(estimate: Estimate) -> Self {
        match estimate {
            Estimate::PaperScaling => Self::PaperScaling,
            Estimate::LineContact => Self::LineContact,
            Estimate::Hertz => Self::Hertz,
        }
    }
}

/// Prints the forecast.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    arguments.stack.refuse_spheres()?;
    let cylinder = Cylinder {
        youngs_modulus: arguments.youngs,
        poisson_ratio: arguments.poisson,
        density: arguments.density.unwrap_or(f64::NAN),
        radius: arguments.radius,
        length: arguments.length,
    };
    let experiment = Experiment {
        cylinder: match arguments.mass {
            Some(mass) => cylinder.weighing(mass),
            None => cylinder,
        },
        mu: arguments.mu.of_cylinders(),
        mu_uncertainty: arguments.mu_uncertainty,
        mu_d: arguments.stack.mu_d,
        kappa: arguments.stack.kappa(Power::Linear),
    };
    let found = [Forecast::new(&experiment, arguments.contact.into()).map_err(as_flag)?];
    let people = || forecast_text(&found[0]);
    let tables = [forecasts(&found)];
    Ok(arguments.format.print(&tables, command, people))
}
