#include "io/detail/vtk_errors.h"

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkXMLReader.h>

#include "io/detail/text_fields.h"

namespace pneuma {

class VtkErrors::Listener : public vtkCommand {
 public:
  static Listener* New() { return new Listener; }

  void Execute(vtkObject* /*caller*/, unsigned long event, void* data) override {
    if (event != vtkCommand::ErrorEvent || !first.empty() || data == nullptr) return;
    // "ERROR: In file, line 12\nvtkClass (0x...): what went wrong"
    std::string_view message = static_cast<const char*>(data);
    const std::size_t colon = message.find("): ");
    if (colon != std::string_view::npos) message.remove_prefix(colon + 3);
    first = trimmed(message);
    for (char& c : first) c = c == '\n' ? ' ' : c;
    if (first.empty()) first = "unknown reason";
  }

  std::string first;
};

struct VtkErrors::State {
  vtkNew<Listener> listener;
};

VtkErrors::VtkErrors(vtkObject& object) : state_(std::make_unique<State>()) {
  object.AddObserver(vtkCommand::ErrorEvent, state_->listener);
  object.AddObserver(vtkCommand::WarningEvent, state_->listener);
}

VtkErrors::VtkErrors(vtkAlgorithm& algorithm) : VtkErrors(static_cast<vtkObject&>(algorithm)) {
  algorithm.GetExecutive()->AddObserver(vtkCommand::ErrorEvent, state_->listener);
  algorithm.GetExecutive()->AddObserver(vtkCommand::WarningEvent, state_->listener);
}

VtkErrors::VtkErrors(vtkXMLReader& reader) : VtkErrors(static_cast<vtkAlgorithm&>(reader)) {
  reader.SetParserErrorObserver(state_->listener);
}

VtkErrors::~VtkErrors() = default;

const std::string& VtkErrors::first() const { return state_->listener->first; }

}  // namespace pneuma
