//! What reading, posing and drawing may allocate. The counters are those of the whole process, so all is one test: the test runner itself would
//! allocate between two.

#[path = "../collada_support/mod.rs"]
mod build;
#[path = "../support/counting.rs"]
mod counting;
#[path = "../render_support/mod.rs"]
mod render_support;

mod budget;
#[cfg(target_os = "linux")]
mod collada_reading;
mod pose_allocations;
mod render_allocations;
mod yaml_bounds;

#[test]
fn memory_and_work_stay_within_their_bounds() {
    pose_allocations::posing_again_allocates_nothing();
    render_allocations::frames_after_the_first_allocate_nothing();
    yaml_bounds::what_the_parser_would_choke_on_is_refused_or_read();
    yaml_bounds::a_second_document_is_refused();
    yaml_bounds::limits_are_named();
    yaml_bounds::the_product_of_nodes_and_muscles_is_bounded_before_anything_is_built();
    yaml_bounds::random_texts_are_small();
    budget::small_files_ask_for_little();
    #[cfg(target_os = "linux")]
    collada_reading::memory_stays_within_ten_times_the_file();
}
