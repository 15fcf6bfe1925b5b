use ambulo::findings::Findings;
use ambulo::gait::{Gait, Walk};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::model::full_body::full_body;
use ambulo::optimal::*;
use ambulo::simulation::consistent_walk::SOFT_SHOES;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let spatial = args.get(1).is_some_and(|a| a == "3d");
    let speed: f64 = args.get(2).map_or(1.3, |a| a.parse().unwrap());
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: true };
    let human = if spatial { full_body(&build).unwrap() } else { build.human().unwrap() };
    let soles = if spatial { soles_with_width(&human) } else { human.soles.clone() };
    let gait = Gait::from_toml(&format!("speed = {speed}")).unwrap();
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).unwrap();
    let mut stages = STAGES.to_vec();
    let mut costs = WalkCosts::default();
    for a in &args[3.min(args.len())..] {
        let (k, v) = a.split_once('=').unwrap();
        if k == "s" { stages.truncate(5); let st = stages[4]; for x in v.split(',') { let (a, u) = x.split_once(':').unwrap(); stages.push(Continuation { creep: 1.0, slack: a.parse().unwrap(), updates: u.parse().unwrap(), steps: 30, ..st }); } continue; }
        let v: f64 = v.parse().unwrap();
        match k { "knots" => costs.knots = v as usize, "per" => costs.per_knot = v as usize, "rate" => costs.moment_rate = v, "slack" => stages[5].slack = v, "upd" => stages[5].updates = v as usize, "steps" => stages[5].steps = v as usize, "slip" => costs.slip = v, "plane" => costs.plane = v.to_radians(), "acc" => costs.acceleration = v, "cr" => { for s in &mut stages { s.creep = s.creep.min(v) } }, "force" => for f in &mut costs.force { *f *= v },  _ => panic!() }
    }
    let problem = WalkProblem::new(&human, &soles, SOFT_SHOES, &walk, &costs).unwrap();
    let start = std::time::Instant::now();
    let solution = problem.solve(&stages).unwrap();
    let s = start.elapsed().as_secs_f64();
    let mut steps = 0;
    let brief = std::env::var("BRIEF").is_ok();
    for p in &solution.progress { println!("{p:?}"); steps += p.steps; }
    println!("{s:.2} s, {steps} steps, {:.1} ms a step, {} unknowns", 1e3 * s / steps as f64, problem.guess.len());
    println!("between: {:?}", solution.root_forces(10).unwrap());
    if std::env::var("ROOT").is_ok() { for (i, f) in solution.forces().enumerate() { let w = 75.0*9.80665; println!("{i} {:.1} {:?}", 50.0 * i as f64 / (problem.problem.instants() - 1) as f64, f[..6].iter().enumerate().map(|(k, x)| (1e6 * x / (if k < 3 { 0.935 * w } else { w })).round()).collect::<Vec<_>>()); } }
    if brief { return; }
    let model = &human.model;
    let w = model.mass() * 9.80665;
    let names = ["hip_flexion_r", "hip_adduction_r", "knee_angle_r", "ankle_angle_r"];
    let ids: Vec<_> = names.iter().filter_map(|n| model.coordinate(n)).collect();
    let idl: Vec<_> = names.iter().filter_map(|n| model.coordinate(&n.replace("_r", "_l"))).collect();
    let right: Vec<usize> = (0..soles.len()).filter(|&k| soles[k].name.contains("_r")).collect();
    let left: Vec<usize> = (0..soles.len()).filter(|&k| soles[k].name.contains("_l") && !right.contains(&k)).collect();
    let f: Vec<Vec<f64>> = solution.forces().map(|x| x.to_vec()).collect();
    let gr: Vec<_> = solution.ground_force(&right).collect();
    let gl: Vec<_> = solution.ground_force(&left).collect();
    let n = f.len() - 1;
    for i in 0..(2 * n) {
        let (g, m, ids) = if i < n { (gr[i], &f[i], &ids) } else { (gl[i - n], &f[i - n], &idl) };
        if i % (n / 12) == 0 {
            print!("{:5.1} {:6.3} {:6.3} {:6.3}  ", 50.0 * i as f64 / n as f64, g[0] / w, g[1] / w, g[2] / w * if i < n { 1.0 } else { -1.0 });
            for id in ids { print!(" {:6.2}", m[id.index()] / model.mass()); }
            let mut posture = [vec![0.0; f[0].len()], vec![0.0; f[0].len()], vec![0.0; f[0].len()]];
            solution.write(walk.cycle_s() * 0.5 * i as f64 / n as f64, &mut posture);
            print!("  |");
            for name in ["hip_flexion_r", "hip_adduction_r", "knee_angle_r", "ankle_angle_r", "pelvis_list", "pelvis_rotation", "subtalar_angle_r"] { if let Some(id) = model.coordinate(name) { print!(" {:6.1}", posture[0][id.index()].to_degrees()); } }
            println!(" {:.3}", posture[0][model.coordinate("pelvis_ty").unwrap().index()]);
        }
    }
}
