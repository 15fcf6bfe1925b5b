//! State machines on a page.

use crate::report_pages::{Shown, recorded};
use serde_json::json;

#[test]
fn a_state_that_comes_back_keeps_its_place() {
    let mut files = recorded();
    let states = "machine,state,start_s,end_s\nleft leg,swing,0,0.2\nleft leg,stance,0.2,0.8\n\
                  left leg,swing,0.8,1\narm,rest,0,1\n";
    files.insert("states.csv".to_owned(), states.as_bytes().to_vec());
    let shown = Shown::of(&files);
    let made = shown.session()["machines"].as_array().unwrap();
    assert_eq!(made.len(), 2);
    assert_eq!(made[0]["states"], json!(["stance", "swing"]));
    let periods = made[0]["periods"].as_array().unwrap();
    assert_eq!(periods.iter().map(|period| period["state"].as_u64().unwrap()).collect::<Vec<_>>(), [1, 0, 1]);
    assert_eq!(made[1]["periods"], json!([{ "state": 0, "from_s": 0.0, "to_s": 1.0 }]));
}
