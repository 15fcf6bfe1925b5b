//! Foot strikes and foot offs from the times during which feet were loaded.

pub use crate::ground::phases::{Contact, SHORTEST_CONTACT_S, contacts_from_force};
use crate::model::Side;
pub use crate::motion::{Event, EventKind};
use crate::numerics::Order;

/// The events of both feet in order of time.
#[must_use]
pub fn events(contacts: &[(Side, Vec<Contact>)]) -> Vec<Event> {
    let mut list = Vec::new();
    for (side, contacts) in contacts {
        for contact in contacts {
            let event = |kind, time_s| Event { side: *side, kind, time_s };
            list.extend(contact.strike_s.map(|t| event(EventKind::Strike, t)));
            list.extend(contact.off_s.map(|t| event(EventKind::Off, t)));
        }
    }
    list.sort_by_numbers(|event| [event.time_s, event.side.rank()]);
    list
}
