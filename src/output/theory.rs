//! The yield force by every theory.

use super::number::{friction, optional, significant};
use super::table::Table;
use crate::theory::Predictions;
use serde::Serialize;

/// One case as an object, several as a list.
pub fn theory_json(predictions: &[Predictions]) -> String {
    let json = match predictions {
        [single] => serde_json::to_string_pretty(single),
        several => serde_json::to_string_pretty(several),
    };
    json.expect("plain data has a JSON form") + "\n"
}

#[derive(Serialize)]
struct FlatRow {
    mu: f64,
    stiffness: f64,
    kappa: f64,
    mu_d: f64,
    epsilon: f64,
    rigid: Option<f64>,
    naive: Option<f64>,
    perturbation: Option<f64>,
    elastic: Option<f64>,
    elastic_x: Option<f64>,
    elastic_y: Option<f64>,
    elastic_z: Option<f64>,
    elastic_theta: Option<f64>,
    quasistatic: Option<f64>,
    event: String,
    floor_slip_force: Option<f64>,
    pair_torque_arm: f64,
    pair_kinematic_arm: f64,
    floor_torque_arm: f64,
    floor_kinematic_arm: f64,
    #[serde(rename = "T")]
    tangent: Option<f64>,
    y: Option<f64>,
}

/// One line a case, forces in m g.
pub fn theory_csv(predictions: &[Predictions]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for case in predictions {
        let row = FlatRow {
            mu: case.mu,
            stiffness: case.stiffness,
            kappa: case.kappa,
            mu_d: case.mu_d,
            epsilon: case.epsilon,
            rigid: case.rigid.yield_force,
            naive: case.naive.yield_force,
            perturbation: case.perturbation.yield_force,
            elastic: case.elastic.yield_force,
            elastic_x: case.elastic.x,
            elastic_y: case.elastic.y,
            elastic_z: case.elastic.z,
            elastic_theta: case.elastic.theta,
            quasistatic: case.quasistatic.yield_force,
            event: case.quasistatic.event.to_string(),
            floor_slip_force: case.quasistatic.floor_slip_force,
            pair_torque_arm: case.quasistatic.arms.pair.torque,
            pair_kinematic_arm: case.quasistatic.arms.pair.kinematic,
            floor_torque_arm: case.quasistatic.arms.floor.torque,
            floor_kinematic_arm: case.quasistatic.arms.floor.kinematic,
            tangent: case.quasistatic.tangent,
            y: case.quasistatic.y,
        };
        writer
            .serialize(row)
            .expect("plain rows are written to memory");
    }
    writer.into_inner().expect("memory is flushed")
}

/// A line a theory, for people.
pub fn theory_table(predictions: &[Predictions]) -> String {
    let tables = predictions.iter().map(|case| {
        let heading = format!(
            "mu = {}, stiffness k_n r/(m g) = {}, kappa = {}, mu_d = {}, arms {}, {}\n",
            friction(case.mu),
            case.stiffness,
            case.kappa,
            case.mu_d,
            case.quasistatic.arms.pair,
            case.quasistatic.arms.floor
        );
        heading + &one_case(case).terminal()
    });
    tables.collect::<Vec<_>>().join("\n")
}

fn one_case(case: &Predictions) -> Table {
    let mut table = Table::new(&["theory", "yield force F>", "remark"]);
    let mut line = |name: &str, force: Option<f64>, remark: String| {
        let force = optional(force, |force| significant(force, 10));
        table.push(vec![name.to_owned(), force, remark]);
    };
    let text = |reason: Option<&str>| reason.unwrap_or_default().to_owned();
    let rigid_remark = case.rigid.diverges.then_some("infinite: mu >= mu_c");
    line("rigid", case.rigid.yield_force, text(rigid_remark));
    line("naive", case.naive.yield_force, text(case.naive.reason));
    line(
        "perturbation",
        case.perturbation.yield_force,
        text(case.perturbation.reason),
    );
    let elastic = &case.elastic;
    line(
        "elastic equation",
        elastic.yield_force,
        text(elastic.reason.or(elastic.caution)),
    );
    let exact = &case.quasistatic;
    let remark = exact.reason.clone().unwrap_or_else(|| "exact".to_owned());
    line("quasi-static limit", exact.yield_force, remark);
    if exact.yield_force.is_none() && exact.floor_slip_force.is_some() {
        let remark = format!("if {} is ignored", exact.event);
        line("", exact.floor_slip_force, remark);
    }
    table
}
