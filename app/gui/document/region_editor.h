#pragma once

#include <QObject>
#include <QString>
#include <optional>
#include <vector>

#include "document/document.h"
#include "render/scene.h"

namespace pneuma {

/// Parts of the lungs that are stiffer or softer, while they are placed and changed: what a click
/// on a lung does, and which of them is chosen. The document keeps them. Needs no display.
class RegionEditor : public QObject {
  Q_OBJECT

 public:
  /// What a click on a lung makes stiffer or softer.
  enum class Placing { Nothing, Lobe, Ball };

  explicit RegionEditor(Document& document, QObject* parent = nullptr);

  const std::vector<StiffnessRegion>& regions() const { return document_.snapshot().regions; }

  Placing placing() const { return placing_; }

  void setPlacing(Placing placing);

  /// A region for a click on a surface; a lobe that has one already gets the factor instead.
  /// Whole lungs have no lobes: it says so.
  /// @param lobe of the surface; @param place on it, at rest, LPS, mm
  void placeAt(Lobe lobe, const Vec3& place);

  /// By its place in regions().
  std::optional<std::size_t> chosen() const { return chosen_; }

  void choose(std::optional<std::size_t> region);

  /// How many times as stiff as healthy lung the chosen region is, or the next one will be.
  double factor() const;

  void setFactor(double factor);

  /// Radius of the chosen ball, or of the next one, mm.
  double radiusMm() const;

  void setRadius(double radiusMm);

  void removeChosen();

  /// "Left lower lobe, 0.5 x", "Ball of 15 mm, 5 x"
  QString textOf(const StiffnessRegion& region) const;

  /// The balls as the scene draws them; with a breath, they move.
  std::vector<SceneBall> balls() const;

 signals:
  void changed();

 private:
  void follow();
  void change(const StiffnessRegion& region, const QString& what);

  Document& document_;
  Placing placing_ = Placing::Nothing;
  std::optional<std::size_t> chosen_;
  double factor_;
  double radiusMm_;
};

}  // namespace pneuma
