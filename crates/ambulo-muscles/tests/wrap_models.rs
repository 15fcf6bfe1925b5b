//! Paths over surfaces of whole models against OpenSim 4.6.

use crate::muscle_models::{MuscleModel, Table, load, postures};
use ambulo_muscles::path::PathWorkspace;
use ambulo_muscles::wrap::WrapRule;

#[test]
fn dump_models() {
    for name in ["rajagopal", "arm26"] {
        let Some(MuscleModel { model, set, findings, .. }) = load(name) else { return };
        println!("{name} {} muscles", set.muscles.len());
        let table = Table::read(&format!("paths_{name}.csv")).unwrap();
        for rule in [WrapRule::Exact, WrapRule::OpenSim] {
            let mut paths = PathWorkspace::new(&model, &set, rule);
            let mut rows = table.rows.iter();
            for (p, (kind, state)) in postures(name, &model).unwrap().into_iter().enumerate() {
                paths.update(state.posture());
                for (i, muscle) in set.muscles.iter().enumerate() {
                    let row = rows.find(|row| table.text(row, "path") == muscle.name).unwrap();
                    if muscle.path.wraps.is_empty() {
                        continue;
                    }
                    let active = table.number(row, "n_wraps_active");
                    let arc = table.number(row, "arc_total_m");
                    let ours: f64 = paths.nodes(i).iter().filter_map(|n| n.arc).sum();
                    let n = paths.nodes(i).iter().filter_map(|n| n.arc).count();
                    let mut arm = 0.0_f64;
                    let mut which = "";
                    for column in table.header.iter().filter(|column| column.starts_with("r:")) {
                        let id = model.coordinate(&column[2..]).unwrap();
                        let difference =
                            (paths.arm(i, id) - table.text(row, column).parse::<f64>().unwrap_or(0.0)).abs();
                        if difference > arm {
                            (arm, which) = (difference, column);
                        }
                    }
                    if (p == 79 || p == 0 || p == 5) && muscle.name == "gasmed_r" {
                        let o = &set.wraps[muscle.path.wraps[0].object];
                        let nodes = paths.nodes(i);
                        let tib = paths.sweep().bodies()[o.body.unwrap().index()].pose * o.pose;
                        println!("P,{rule:?},{p},{:?},{:?},{:?}", o.pose.rotation, o.pose.translation, o.shape);
                        for n in nodes {
                            println!(
                                "P,{rule:?},{p},{:?},{:?}",
                                tib.rotation.tr_mul(&(n.place - tib.translation)),
                                n.arc
                            );
                        }
                    }
                    if p == 29 && muscle.name == "gaslat_r" {
                        for n in paths.nodes(i) {
                            let (name, pose) = n.body.map_or(("ground", ambulo_body::spatial::Pose::IDENTITY), |b| {
                                (model.bodies()[b.index()].name.as_str(), paths.sweep().bodies()[b.index()].pose)
                            });
                            let l = pose.rotation.tr_mul(&(n.place - pose.translation));
                            println!(
                                "N,{rule:?},{name},{:.9},{:.9},{:.9},{:.9},{:.9},{:.9},{:?}",
                                n.place.x, n.place.y, n.place.z, l.x, l.y, l.z, n.arc
                            );
                        }
                    }
                    println!(
                        "D,{name},{rule:?},{p},{kind},{},{},{:e},{active},{n},{arc:.6},{ours:.6},{arm:e},{which},{:?}",
                        muscle.name,
                        muscle.path.wraps.len(),
                        table.number(row, "length_m") - paths.lengths()[i],
                        paths.contacts(i)
                    );
                }
            }
        }
    }
}
