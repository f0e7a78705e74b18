#include <stdexcept>

#include "output/free_memory.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/hdf5/hdf5_parts.hpp"

namespace railwave::hdf5 {
namespace {

constexpr std::size_t copies_of_text = 4;  ///< that HDF5 makes of a text on its way
constexpr hssize_t most_texts = 1 << 20;   ///< of a list: more is damage

}  // namespace

Handle Group::new_attribute(const std::string& name, hid_t type, hid_t space) const {
  const std::string what = "writing attribute " + name + " of " + name_;
  if (check(H5Aexists(id_.get(), name.c_str()), what) > 0) {
    Handle there(check(H5Aopen(id_.get(), name.c_str(), H5P_DEFAULT), what), H5Aclose);
    const Handle its_type(check(H5Aget_type(there.get()), what), H5Tclose),
        its_space(check(H5Aget_space(there.get()), what), H5Sclose);
    // In its place, so that a kill in the middle of a flush does not find it taken away and not yet put back.
    if (H5Tequal(its_type.get(), type) > 0 && H5Sextent_equal(its_space.get(), space) > 0) return there;
    there.close();
    check(H5Adelete(id_.get(), name.c_str()), what);
  }
  return {check(H5Acreate2(id_.get(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), what), H5Aclose};
}

void Group::set_attribute(const std::string& name, double value) const {
  expect_free_memory();
  const Handle space = space_of({});
  const Handle attribute = new_attribute(name, H5T_NATIVE_DOUBLE, space.get());
  check(H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, &value), "writing attribute " + name);
}

void Group::set_attribute(const std::string& name, long value) const {
  expect_free_memory();
  const Handle space = space_of({});
  const Handle attribute = new_attribute(name, H5T_NATIVE_LONG, space.get());
  check(H5Awrite(attribute.get(), H5T_NATIVE_LONG, &value), "writing attribute " + name);
}

void Group::set_attribute(const std::string& name, const std::string& value) const {
  expect_free_memory(copies_of_text * value.size());
  const Handle space = space_of({}), type = text_type();
  const Handle attribute = new_attribute(name, type.get(), space.get());
  const char* text = value.c_str();
  check(H5Awrite(attribute.get(), type.get(), &text), "writing attribute " + name);
}

void Group::set_attribute(const std::string& name, const std::vector<std::string>& values) const {
  std::size_t length = 0;
  for (const std::string& value : values) length += value.size() + sizeof(value);
  expect_free_memory(copies_of_text * length);
  const Handle space = space_of({values.size()}), type = text_type();
  const Handle attribute = new_attribute(name, type.get(), space.get());
  if (values.empty()) return;
  std::vector<const char*> texts;
  for (const auto& value : values) texts.push_back(value.c_str());
  check(H5Awrite(attribute.get(), type.get(), texts.data()), "writing attribute " + name);
}

void Group::set_attribute(const std::string& name, const std::vector<long>& values) const {
  expect_free_memory();
  const Handle space = space_of({values.size()});
  const Handle attribute = new_attribute(name, H5T_NATIVE_LONG, space.get());
  if (!values.empty()) check(H5Awrite(attribute.get(), H5T_NATIVE_LONG, values.data()), "writing attribute " + name);
}

void Group::set_fixed_text_attribute(const std::string& name, const std::string& value) const {
  expect_free_memory(copies_of_text * value.size());
  const Handle space = space_of({}), type(check(H5Tcopy(H5T_C_S1), "making a text type"), H5Tclose);
  check(H5Tset_size(type.get(), value.size()), "making a text type");
  check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), "making a text type");
  const Handle attribute = new_attribute(name, type.get(), space.get());
  check(H5Awrite(attribute.get(), type.get(), value.data()), "writing attribute " + name);
}

bool Group::has_attribute(const std::string& name) const {
  expect_free_memory();
  const LimitedCall limited;
  return check(H5Aexists(id_.get(), name.c_str()), "looking for attribute " + name) > 0;
}

double Group::number_attribute(const std::string& name) const {
  expect_free_memory();
  const LimitedCall limited;
  const std::string what = "reading attribute " + name + " of " + name_;
  const Handle attribute(check(H5Aopen(id_.get(), name.c_str(), H5P_DEFAULT), what), H5Aclose);
  const Handle space(check(H5Aget_space(attribute.get()), what), H5Sclose);
  if (H5Sget_simple_extent_npoints(space.get()) != 1) throw std::runtime_error(what + ": it is not one number");
  double value = 0;
  check(H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value), what);
  return value;
}

std::string Group::text_attribute(const std::string& name) const {
  expect_free_memory();
  const LimitedCall limited;
  const std::string what = "reading attribute " + name + " of " + name_;
  const Handle attribute(check(H5Aopen(id_.get(), name.c_str(), H5P_DEFAULT), what), H5Aclose);
  const Handle stored(check(H5Aget_type(attribute.get()), what), H5Tclose);
  const Handle space(check(H5Aget_space(attribute.get()), what), H5Sclose);
  if (H5Tis_variable_str(stored.get()) <= 0 || H5Sget_simple_extent_npoints(space.get()) != 1)
    throw std::runtime_error(what + ": it is not a text");
  const Handle type = text_type();
  char* text = nullptr;
  check(H5Aread(attribute.get(), type.get(), &text), what);
  const std::string value = text ? text : "";
  H5free_memory(text);
  return value;
}

std::vector<std::string> Group::texts_attribute(const std::string& name) const {
  expect_free_memory();
  const LimitedCall limited;
  const std::string what = "reading attribute " + name + " of " + name_;
  const Handle attribute(check(H5Aopen(id_.get(), name.c_str(), H5P_DEFAULT), what), H5Aclose);
  const Handle stored(check(H5Aget_type(attribute.get()), what), H5Tclose);
  const Handle space(check(H5Aget_space(attribute.get()), what), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (H5Tis_variable_str(stored.get()) <= 0 || count < 0 || count > most_texts)
    throw std::runtime_error(what + ": it is no list of texts");
  const Handle type = text_type();
  std::vector<char*> read(static_cast<std::size_t>(count), nullptr);
  if (count > 0) check(H5Aread(attribute.get(), type.get(), read.data()), what);
  std::vector<std::string> texts;
  for (char* text : read) texts.emplace_back(text ? text : "");
  for (char* text : read) H5free_memory(text);
  return texts;
}

}  // namespace railwave::hdf5
