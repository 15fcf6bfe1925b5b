//! scratch
mod common;
use ambulo::dynamics::*;
use ambulo::spatial::Vec3;
use common::graphs::*;
use common::random::Random;

fn show(name: &str, graph: &ConstraintGraph, tol: f64, max: usize) {
    for method in METHODS {
        let t = std::time::Instant::now();
        let (s, _) = solved(graph, &settings(method, tol, max));
        let mut again = s.clone();
        let mut moved = graph.clone();
        for w in &mut moved.wrenches {
            *w *= 1.01;
        }
        solve_graph(&moved, &settings(method, tol, max), &mut GraphWorkspace::default(), &mut again).unwrap();
        print!("warm {:4} {:4}; ", again.convergence.iterations, again.convergence.factorizations);
        println!(
            "{name:30} {method:?} {:?} {:.2} ms, lmax {:.3e}",
            s.convergence,
            t.elapsed().as_secs_f64() * 1e3,
            s.lambda.iter().fold(0.0f64, |m, x| m.max(x.abs()))
        );
    }
}

#[test]
fn scratch() {
    let edges = Vec3::new(1.0, 0.6, 0.7);
    show("table", &box_on(20.0, edges, &corners(edges), 0.5), 1e-10, 100);
    for push in [50.0, 90.0, 110.0, 200.0] {
        let mut g = box_on(20.0, edges, &corners(edges), 0.5);
        g.wrenches[0][3] = push;
        g.wrenches[0][4] = 0.3 * push;
        show(&format!("table pushed {push}"), &g, 1e-10, 100);
        g.wrenches[0][2] = 30.0;
        show(&format!("table pushed+turned {push}"), &g, 1e-10, 100);
    }
    for n in [1, 10, 100, 1000] {
        show(&format!("ladder plane {n}"), &ladder(n, &PLANE), 1e-10, 20000);
        show(&format!("ladder space {n}"), &ladder(n, &SPACE), 1e-10, 20000);
    }
    let mut r = Random::new(1);
    let pts: Vec<_> = (0..1000).map(|_| Vec3::new(r.within(0.5), r.within(0.3), -0.35)).collect();
    show("1000 points", &box_on(20.0, edges, &pts, 0.5), 1e-10, 2000);
    let mut g = box_on(20.0, edges, &pts, 0.5);
    g.wrenches[0][3] = 70.0;
    show("1000 points pushed", &g, 1e-10, 2000);
    g.wrenches[0][3] = 130.0;
    g.wrenches[0][2] = 20.0;
    show("1000 points sliding", &g, 1e-10, 2000);
    for n in [10, 50, 250] {
        show(&format!("tower {n}"), &tower(&vec![1.0; n], 0.5), 1e-10, 20000);
        let mut g = tower(&vec![1.0; n], 0.5);
        g.wrenches[n - 1][3] = 8.0;
        show(&format!("tower pushed {n}"), &g, 1e-10, 20000);
    }
    show("mass ratio", &tower(&[1.0, 1000.0], 0.5), 1e-10, 2000);
    show("mass ratio", &tower(&[1000.0, 1.0], 0.5), 1e-10, 2000);
}

#[test]
fn trace() {
    let edges = Vec3::new(1.0, 0.6, 0.7);
    let mut g = box_on(20.0, edges, &corners(edges), 0.5);
    g.wrenches[0][3] = 200.0;
    g.wrenches[0][4] = 60.0;
    g.wrenches[0][2] = 30.0;
    show("trace", &g, 1e-10, 100);
    println!("TOWER");
    let n = 250;
    let mut g = tower(&vec![1.0; n], 0.5);
    g.wrenches[n - 1][3] = 8.0;
    show(&format!("tower pushed {n}"), &g, 1e-10, 200);
}

#[test]
fn survey() {
    for mu in [0.0, 0.3, 1.0] {
        let mut tally = std::collections::BTreeMap::new();
        let mut counts = [vec![], vec![]];
        let mut bad = vec![];
        for seed in 0..3000 {
            let g = random_contacts(&mut Random::new(seed), mu);
            let mut c = vec![];
            for (k, method) in METHODS.into_iter().enumerate() {
                let (s, _) = solved(&g, &settings(method, 1e-10, if method == Method::Newton { 200 } else { 3000 }));
                assert!(s.lambda.iter().all(|x| x.is_finite()), "seed {seed} mu {mu} {method:?} {:?}", s.lambda);
                if s.convergence.converged {
                    counts[k].push(s.convergence.iterations);
                }
                c.push(s.convergence);
            }
            *tally.entry((c[0].converged, c[1].converged)).or_insert(0) += 1;
            if c[0].converged != c[1].converged {
                bad.push((seed, c[0].residual, c[1].residual));
            }
        }
        for c in &mut counts {
            c.sort();
        }
        println!("mu {mu} {tally:?} {:?}", &bad[..bad.len().min(8)]);
        for (k, c) in counts.iter().enumerate() {
            println!(
                "   mu {:?} median {} 90% {} 99% {}",
                METHODS[k],
                c[c.len() / 2],
                c[c.len() * 9 / 10],
                c[c.len() * 99 / 100]
            );
        }
    }
}

#[test]
fn one() {
    let seed = std::env::var("SEED").unwrap().parse().unwrap();
    let mu = std::env::var("MU").unwrap().parse().unwrap();
    let g = random_contacts(&mut Random::new(seed), mu);
    println!("{:?}", g.groups);
    println!("{:?}", g.links);
    show("one", &g, 1e-10, 300);
}
