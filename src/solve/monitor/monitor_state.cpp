#include <fmt/format.h>

#include "solve/monitor/monitor.hpp"

/// The monitor's memory as part of a run's state.
namespace railwave {
namespace {

template <class Archive>
void archive_text(Archive& archive, const std::string& name, std::string& text) {
  std::vector<char> letters(text.begin(), text.end());
  archive.values(name, letters);
  text.assign(letters.begin(), letters.end());
}

template <class Archive, class T>
void archive_size(Archive& archive, const std::string& name, std::vector<T>& list) {
  std::size_t size = list.size();
  archive.value(name, size);
  list.resize(size);
}

template <class Archive>
void archive_fault(Archive& archive, const std::string& of, Fault& fault) {
  archive.value(of + "kind", fault.kind);
  archive.value(of + "fatal", fault.fatal);
  archive.value(of + "time", fault.time);
  archive.value(of + "step", fault.step);
  archive.value(of + "value", fault.value);
  archive.value(of + "limit", fault.limit);
  archive_text(archive, of + "part", fault.part);
  archive_text(archive, of + "contact", fault.contact);
  archive.value(of + "element", fault.element);
  archive.value(of + "element_in_part", fault.element_in_part);
  archive.value(of + "node", fault.node);
  archive.value(of + "place", fault.place);
  archive.value(of + "element_volume", fault.element_volume);
  archive_size(archive, of + "causes", fault.causes);
  for (std::size_t c = 0; c < fault.causes.size(); ++c) {
    const std::string one = fmt::format("{}cause_{}_", of, c);
    archive_text(archive, one + "name", fault.causes[c].name);
    archive_text(archive, one + "told", fault.causes[c].text);
    archive.value(one + "weight", fault.causes[c].weight);
  }
}

template <class Archive>
void archive_measures(Archive& archive, const std::string& of, MonitorMeasures& measures) {
  archive.value(of + "jacobian", measures.jacobian);
  archive.value(of + "distortion", measures.distortion);
  archive.value(of + "speed", measures.speed);
  archive.value(of + "acceleration", measures.acceleration);
  archive.values(of + "penetration", measures.penetration);
  archive.values(of + "chatter", measures.chatter);
}

}  // namespace

template <class Archive>
void Monitor::archive_all(Archive& archive) {
  archive_size(archive, "watch_found", found_);
  for (std::size_t f = 0; f < found_.size(); ++f) archive_fault(archive, fmt::format("watch_found_{}_", f), found_[f]);
  if (!arrays_) return;
  archive.value("watch_begun", begun_);
  archive.value("watch_odd", odd_);
  archive.value("watch_given_at_start", given_at_start_);
  archive.value("watch_given", given_);
  archive.value("watch_deformation", deformation_);
  archive.value("watch_impacts", impacts_);
  archive.value("watch_work", work_);
  archive.value("watch_rate_at_start", rate_at_start_);
  archive.value("watch_share_before", share_before_);
  archive.value("watch_lasting_error", lasting_error_);
  archive.value("watch_lasting_growth", lasting_growth_);
  archive.value("watch_worst", worst_);
  archive.values("watch_parts", parts_);
  archive_measures(archive, "watch_first_", evidence_.first);
  archive_measures(archive, "watch_last_", evidence_.last);
  archive.values("watch_deepest", evidence_.deepest);
  arrays_->archive(archive);
  if (!ends_) return;
  ends_->archive(archive);
  archive.value("watch_wants_look", wants_check_);
}

template void Monitor::archive_all(StateSaver&);
template void Monitor::archive_all(StateRestorer&);

}  // namespace railwave
