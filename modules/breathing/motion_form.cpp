#include "breathing/motion_form.h"

namespace pneuma {
namespace {

struct FieldOf {
  const LungFrame& frame;
  double strain;

  std::variant<PolynomialField, PublishedField> operator()(const PolynomialForm& form) const {
    return PolynomialField(form, frame, strain);
  }

  std::variant<PolynomialField, PublishedField> operator()(const PublishedForm& form) const {
    return PublishedField(form, frame, strain);
  }
};

}  // namespace

TermChoice termsOf(FormKind kind) {
  return termsOf(kind == FormKind::Quiet ? MotionPreset::Quiet : MotionPreset::Deep);
}

std::size_t constantCount(FormKind kind) {
  constexpr std::size_t OfPublished = 9;
  return kind == FormKind::Published ? OfPublished
                                     : static_cast<std::size_t>(termsOf(kind).count());
}

std::vector<double> constantsOf(const MotionForm& form, FormKind kind) {
  if (kind == FormKind::Published) {
    const auto& [weights, powers, constant, slopes] = std::get<PublishedForm>(form);
    return {weights.x(), weights.y(), powers.x(), powers.y(), powers.z(),
            constant,    slopes.x(),  slopes.y(), slopes.z()};
  }
  const auto& constants = std::get<PolynomialForm>(form).constants;
  const TermChoice used = termsOf(kind);
  std::vector<double> list;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < PolynomialForm::Terms; ++j) {
      if (used(k, j)) list.push_back(constants(k, j));
    }
  }
  return list;
}

MotionForm formOf(FormKind kind, const std::vector<double>& c) {
  if (kind == FormKind::Published) {
    return PublishedForm{{c[0], c[1], 1.0}, {c[2], c[3], c[4]}, c[5], {c[6], c[7], c[8]}};
  }
  const TermChoice used = termsOf(kind);
  PolynomialForm form;
  std::size_t n = 0;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < PolynomialForm::Terms; ++j) {
      if (used(k, j)) form.constants(k, j) = c[n++];
    }
  }
  return form;
}

FormField::FormField(const MotionForm& form, const LungFrame& frame, double strain)
    : field_(std::visit(FieldOf{frame, strain}, form)) {}

Vec3 FormField::at(const Vec3& p) const {
  return std::visit([&](const auto& field) { return field.at(p); }, field_);
}

Mat3 FormField::gradientAt(const Vec3& p) const {
  return std::visit([&](const auto& field) { return field.gradientAt(p); }, field_);
}

}  // namespace pneuma
