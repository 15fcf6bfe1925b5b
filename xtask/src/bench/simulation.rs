//! Time per step of our simulator on the peers' scenes.

use super::worlds;
use ambulo::findings::Findings;
use ambulo::simulation::{State, StepSettings, StepWorkspace, World, largest_joint_error, step};
use cpu_time::ThreadTime;

pub(crate) fn run(name: &str, w: &World, steps: usize, settings: StepSettings) {
    let mut s = State::new(w);
    let mut ws = StepWorkspace::default();
    let mut f = Findings::default();
    let (mut worst, mut its, mut facs, mut res) = (0.0_f64, 0, 0, 0.0_f64);
    let mut t = Vec::new();
    for _ in 0..steps {
        let a = ThreadTime::now();
        let c = step(w, &mut s, &settings, &mut ws, &mut f).expect("forest");
        t.push(a.elapsed().as_secs_f64());
        if w.surfaces.len() > 5 && (t.len() % 50 == 1 || t.len() < 8) && t.len() < 200 { println!("{} it {} fac {} res {:.1e} contacts {} pelvis {:?} E {:.3}", t.len(), c.iterations, c.factorizations, c.residual, ws.forces(w).contacts.len(), s.poses[0].translation.as_slice(), ambulo::simulation::energy(w, &s).total()); }
        its += c.iterations; facs += c.factorizations; res = res.max(c.residual);
        worst = worst.max(largest_joint_error(w, &s));
    }
    t.sort_by(f64::total_cmp);
    println!("{name}: median {:.2} us/step p10 {:.2} p90 {:.2}, it {:.2} fac {:.2} worst res {res:.1e}, joint error {worst:.1e}; findings {:?}", t[steps/2] * 1e6, t[steps/10]*1e6, t[steps*9/10]*1e6, its as f64 / steps as f64, facs as f64 / steps as f64, f.as_slice().first());
    if !w.surfaces.is_empty() {
        let fo = ws.forces(w);
        let sum: ambulo::spatial::Vec3 = fo.contacts.iter().map(|c| c.force).sum();
        println!("   contacts {} sum {:?} weight {} pelvis {:?}", fo.contacts.len(), sum.as_slice(), w.mass() * w.gravity.norm(), s.poses[0].translation.as_slice());
        for c in fo.contacts.iter().take(12) { println!("     {:?} {:?} gap {:.2e} slip {:.2e}", c.surfaces, c.force.as_slice(), c.gap, c.slip.norm()); }
    }
}

pub(crate) fn all() {
    let d = StepSettings::default();
    let xml = std::fs::read_to_string("/work/shared/reference/peers/data/human_contact.xml").unwrap();
    let h = worlds::human(&xml).unwrap();
    run("human", &h, 10000, d);
    run("chain 1000", &worlds::chain(1000), 200, d);
}
