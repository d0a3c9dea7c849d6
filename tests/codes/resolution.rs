//! Codes in single precision, and codes that print few digits, judged to what they resolve: copies of the Python example.

use crate::schemes::{changed, make_elsewhere, rows};

/// Positions, velocities and springs of 32 bits.
const STATE: [[&str; 2]; 3] = [
    [
        "import json\n",
        "import json\nfrom ctypes import c_float\n\ndef single(value): return c_float(value).value\n",
    ],
    [
        "self.angle + self.spin * dt\n",
        "self.angle + self.spin * dt\n        for name in (\"x\", \"y\", \"angle\", \"vx\", \"vy\", \"spin\"):\n            setattr(self, name, single(getattr(self, name)))\n",
    ],
    ["self.stretch = stretch ", "self.stretch = single(stretch) "],
];

/// Forces and springs of 32 bits.
const FORCES: [[&str; 2]; 5] = [
    STATE[0],
    STATE[2],
    [
        "self.normal = self.kn * overlap - self.cn * separation",
        "self.normal = single(self.kn * overlap - self.cn * separation)",
    ],
    [
        "self.tangential = -self.kt * stretch - self.ct * sliding",
        "self.tangential = single(-self.kt * stretch - self.ct * sliding)",
    ],
    [
        "        self.vx += self.fx / MASS * dt\n",
        "        self.fx, self.fy, self.torque = map(single, (self.fx, self.fy, self.torque))\n        self.vx += self.fx / MASS * dt\n",
    ],
];

/// Numbers printed with seven digits.
const PRINTED: [[&str; 2]; 1] = [[
    "print(*row,",
    "print(*(f\"{value:.6e}\" if isinstance(value, float) else value for value in row),",
]];

const CROSSCHECK: &str = "crosscheck --codes ./mydem --mu 0.2 --stiffness 100 --format json";

#[test]
fn a_code_is_judged_to_what_it_resolves_where_that_is_accepted() {
    let single = "inconclusive (single precision)";
    for (name, changes, cause, resolution) in [
        ("state", &STATE[..], single, 1e-2),
        ("forces", &FORCES[..], single, 1e-3),
        ("printed", &PRINTED[..], "inconclusive (few digits)", 1e-3),
    ] {
        let bench = changed(changes.iter().copied());
        let (status, judged, messages) = rows(&bench, CROSSCHECK);
        assert_eq!((status, judged.len()), (4, 1), "{name}: {messages}");
        assert!(messages.contains(cause), "{name}: {messages}");

        let accepting = format!("{CROSSCHECK} --resolution {resolution}");
        let (status, judged, messages) = rows(&bench, &accepting);
        assert_eq!(status, 0, "{name}: {messages}");
        assert_eq!(judged[0]["verdict"], "agrees", "{name}: {messages}");
        let tolerance = judged[0]["tolerance"].as_f64().expect("a number");
        assert!(tolerance <= resolution, "{name}: {tolerance:e}");

        // In compressions alone, so that no probe shows it.
        let wrong = format!(
            "    task[\"floor_friction\"] *= {}\n    top, right, left = bodies",
            1.0 + 3.0 * resolution
        );
        let friction = ["    top, right, left = bodies", wrong.as_str()];
        let bench = changed(changes.iter().copied().chain([friction]));
        let (status, judged, messages) = rows(&bench, &accepting);
        assert_eq!(status, 2, "{name}: {messages}");
        assert_eq!(judged[0]["verdict"], "differs", "{name}: {messages}");
    }
}

/// The resolution stands in the plan, and the walls are planned for what the micro-tests show.
#[test]
fn a_plan_carries_the_resolution_to_the_judge() {
    let bench = changed(STATE.iter().copied());
    make_elsewhere(&bench, "--mu 0.2 --stiffness 100 --resolution 1e-2");
    let (status, judged, messages) = rows(&bench, "judge away --format json");
    assert_eq!((status, judged.len()), (0, 1), "{messages}");
    assert_eq!(judged[0]["verdict"], "agrees", "{messages}");

    let plan = bench.path("away/plan.json");
    let text = std::fs::read_to_string(&plan).expect("a plan");
    let wrong = text.replace("\"resolution\": 0.01", "\"resolution\": 7.0");
    assert_ne!(wrong, text);
    std::fs::write(&plan, wrong).expect("it can be written");
    let output = bench.tristack("judge away").output().expect("it runs");
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(
        told.contains("`resolution` is 7; accepted is 1e-5 to 0.1"),
        "{told}"
    );
}
