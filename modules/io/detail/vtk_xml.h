#pragma once

#include <string>
#include <string_view>

class vtkPointSet;
class vtkPolyData;
template <class T>
class vtkSmartPointer;

/// VTK's XML files (VTP, VTU), read from and written to memory.
namespace pneuma {

/// True if `content` begins as one of VTK's XML files does.
bool looksLikeVtkXml(const std::string& content);

/// VTK's parser recurses into elements: throws InvalidInput if they are nested deeper than any of
/// its own files. @param header the text in which elements stand
void requireFlatXml(std::string_view header, const std::string& name);

/// Throws unless the file is complete and every array has the size it says, so that VTK's readers,
/// which allocate first and do not always check, can be let loose on it.
/// @returns the data set's type: "PolyData" or "UnstructuredGrid"
/// @throws InvalidInput, Unsupported for another type of data set
std::string requireSoundVtkXml(const std::string& content, const std::string& name);

/// Reads a VTP or VTU file. Coordinates are finite and cells name existing points only.
/// @param name of the file, in quotation marks, for messages
/// @throws InvalidInput, Unsupported
vtkSmartPointer<vtkPointSet> readVtkXml(const std::string& content, const std::string& name);

/// @throws InvalidInput unless all coordinates are finite and all cells name existing points
void requireSoundGeometry(vtkPointSet& data, const std::string& name);

/// The VTP file with these data, arrays appended as they lie in memory.
std::string vtpText(vtkPolyData& data);

/// The text of a string array of the field data, "" if there is none.
std::string fieldText(vtkPointSet& data, const char* key);

void setFieldText(vtkPolyData& data, const std::string& key, const std::string& value);

}  // namespace pneuma
