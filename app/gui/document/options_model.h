#pragma once

#include <QAbstractTableModel>
#include <any>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/options.h"

namespace pneuma {

/// Any options struct with fields() as a table of rows that can be edited: name, value, unit,
/// allowed range, help. Knows no struct in particular.
class OptionsModel : public QAbstractTableModel {
  Q_OBJECT

 public:
  enum Column { NameColumn, ValueColumn, UnitColumn, RangeColumn, HelpColumn, ColumnCount };

  struct Row {
    std::string name;  ///< as typed on the command line: "min-length"
    std::string unit;
    std::string help;
    Range range;
    bool whole = false;                ///< whole numbers only
    std::vector<std::string> choices;  ///< of an enum; empty for numbers
    std::string value;
    std::string standard;  ///< the value that nobody has set
  };

  using QAbstractTableModel::QAbstractTableModel;

  /// Shows these options from now on.
  template <HasFields Options>
  void bind(const Options& options) {
    beginResetModel();
    options_ = options;
    set_ = [](std::any& any, const std::string& key, const std::string& text) {
      setOption(*std::any_cast<Options>(&any), key, text);
    };
    read_ = [](const std::any& any) { return rowsOf(*std::any_cast<Options>(&any)); };
    rows_ = read_(options_);
    endResetModel();
  }

  /// The options as edited. @pre bind() was called with the same type
  template <HasFields Options>
  Options options() const {
    return *std::any_cast<Options>(&options_);
  }

  const Row& row(int index) const { return rows_[static_cast<std::size_t>(index)]; }

  std::optional<int> rowOf(std::string_view name) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;

  /// Sets a value from its text. What is out of range is not taken: refused() says why.
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 signals:
  void refused(const QString& sentence);

 private:
  template <HasFields Options>
  static std::vector<Row> rowsOf(const Options& options);

  std::any options_;
  std::function<void(std::any&, const std::string&, const std::string&)> set_;
  std::function<std::vector<Row>(const std::any&)> read_;
  std::vector<Row> rows_;
};

template <HasFields Options>
std::vector<OptionsModel::Row> OptionsModel::rowsOf(const Options& options) {
  std::vector<Row> rows;
  const Options standard{};
  forEachField<Options>([&](const auto& field) {
    using Value = typename std::remove_cvref_t<decltype(field)>::value_type;
    Row row{std::string(field.name),         std::string(field.unit),
            std::string(field.help),         field.range,
            std::is_integral_v<Value>,       {},
            textOf(options.*(field.member)), textOf(standard.*(field.member))};
    if constexpr (std::is_enum_v<Value>) {
      for (const auto choice : choices(Value{})) row.choices.emplace_back(choice);
    }
    rows.push_back(std::move(row));
  });
  return rows;
}

}  // namespace pneuma
