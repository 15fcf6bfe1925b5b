//! The page of a batch of trials.

use ambulo_report::{BATCH_QUANTITIES, BatchTrial, batch_page};

fn trial(name: &str, residual_bw: f64, error: Option<&str>) -> BatchTrial {
    let mut values = [f64::NAN; BATCH_QUANTITIES.len()];
    values[0] = residual_bw;
    let state = |word: &str| error.is_none().then(|| word.to_owned());
    BatchTrial {
        name: name.to_owned(),
        person: "Ann".to_owned(),
        error: error.map(str::to_owned),
        quality: state("bad"),
        verdict: state("feasible"),
        reasons: vec!["<feet> slide".to_owned()],
        values,
    }
}

#[test]
fn the_page_has_counts_quantiles_reasons_and_failures_and_no_markup_of_the_files() {
    let mut trials: Vec<BatchTrial> = (0..=100).map(|k| trial(&format!("walk {k}"), f64::from(k), None)).collect();
    trials.extend(["one", "two"].map(|name| trial(name, f64::NAN, Some("no markers"))));
    let worst = [(&trials[0], "ambulo forces 'walk 0.c3d'".to_owned())];
    let page = batch_page("<set>", &trials, &worst).unwrap();
    assert!(page.contains("101 of 103 trials were computed (persons: 1)"), "{page}");
    assert!(page.contains("Quality of the data: 101 bad. Motion: 101 feasible."));
    let row: String = ["101", "0.000", "5.000", "50.000", "95.000", "100.000"]
        .map(|cell| format!("<td class=\"number\">{cell}</td>"))
        .concat();
    assert!(page.contains(&row), "{page}");
    assert!(page.contains("&lt;feet&gt; slide") && !page.contains("<feet>") && !page.contains("<set>"));
    assert!(
        page.contains("ambulo forces &#39;walk 0.c3d&#39;") || page.contains("ambulo forces 'walk 0.c3d'"),
        "{page}"
    );
    assert!(page.contains("no markers</th><td class=\"number\">2</td><td>one</td>"), "{page}");
    assert!(!page.contains("Body mass</th>"), "a quantity without values has no row");
}

#[test]
fn a_batch_without_results_has_a_page() {
    let page = batch_page("set", &[trial("one", f64::NAN, Some("no markers"))], &[]).unwrap();
    assert!(page.contains("0 of 1 trials") && page.contains("no markers"));
}
