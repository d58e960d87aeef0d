#include "mpm/occt/shape_file.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Reader.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_StepModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <fstream>
#include <iostream>
#include <mutex>
#include <sstream>

#include "mpm/base/error.h"
#include "mpm/occt/failure.h"

namespace mpm::occt {
namespace {

constexpr char kFixedTime[] = "2000-01-01T00:00:00";
constexpr std::size_t kHeadLength = 256;
constexpr std::size_t kIgesSectionColumn =
    72;  // an IGES line is 80 characters: 72 of text, the section's letter, a number

enum class Format { step, iges, brep, binary_brep, unknown };

std::mutex& exchange_mutex() {
  static std::mutex mutex;
  return mutex;
}

// The readers report to the program's standard output, some through the messenger, some directly; a library
// keeps quiet. Restores both on leaving. Used under exchange_mutex() only.
class QuietOutput {
 public:
  QuietOutput() : printers_(Message::DefaultMessenger()->Printers()), buffer_(std::cout.rdbuf(nullptr)) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~QuietOutput() {
    Message::DefaultMessenger()->ChangePrinters() = printers_;
    std::cout.rdbuf(buffer_);
  }
  QuietOutput(const QuietOutput&) = delete;
  QuietOutput& operator=(const QuietOutput&) = delete;

 private:
  Message_SequenceOfPrinters printers_;
  std::streambuf* buffer_;
};

std::string head_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  require(bool(file), "cannot be opened for reading");
  std::string head(kHeadLength, '\0');
  file.read(head.data(), std::streamsize(head.size()));
  head.resize(std::size_t(file.gcount()));
  require(!head.empty(), "is empty; a STEP, IGES or BREP file is needed");
  return head;
}

Format format_of(const std::string& head) {
  const auto has = [&](const char* mark) { return head.find(mark) != std::string::npos; };
  if (has("ISO-10303-21")) return Format::step;
  if (has("Open CASCADE Topology V")) return Format::binary_brep;
  if (has("DBRep_DrawableShape") || has("CASCADE Topology V")) return Format::brep;
  const bool iges = head.size() > kIgesSectionColumn &&
                    std::string("SCFBG").find(head[kIgesSectionColumn]) != std::string::npos;
  return iges ? Format::iges : Format::unknown;
}

// The settings exist only once the controllers do, and readers and writers look at them when they are made.
void use_millimetres() {
  STEPControl_Controller::Init();
  IGESControl_Controller::Init();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  Interface_Static::SetCVal("write.step.unit", "MM");
}

template <class Reader>
TopoDS_Shape read_exchange(const std::string& path) {
  use_millimetres();
  Reader reader;
  require(reader.ReadFile(path.c_str()) == IFSelect_RetDone, "is damaged: it cannot be parsed");
  reader.TransferRoots();
  return reader.OneShape();
}

TopoDS_Shape read_brep(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  TopoDS_Shape shape;
  BRepTools::Read(shape, file, BRep_Builder());
  return shape;
}

TopoDS_Shape read_binary_brep(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  TopoDS_Shape shape;
  BinTools::Read(shape, file);
  return shape;
}

TopoDS_Shape read_any(const std::string& path) {
  switch (format_of(head_of(path))) {
    case Format::step:
      return read_exchange<STEPControl_Reader>(path);
    case Format::iges:
      return read_exchange<IGESControl_Reader>(path);
    case Format::brep:
      return read_brep(path);
    case Format::binary_brep:
      return read_binary_brep(path);
    case Format::unknown:
      break;
  }
  throw std::invalid_argument("is not a STEP, IGES or BREP file");
}

// The library numbers the products that a process writes; all get the given name instead.
void name_products(const StepData_StepModel& model, const Handle(TCollection_HAsciiString) & name) {
  for (int i = 1; i <= model.NbEntities(); ++i)
    if (const auto product = Handle(StepBasic_Product)::DownCast(model.Value(i)); !product.IsNull()) {
      product->SetId(name);
      product->SetName(name);
    }
}

void name_and_date(const Handle(StepData_StepModel) & model, const std::string& name) {
  const Handle(TCollection_HAsciiString) text = new TCollection_HAsciiString(name.c_str());
  APIHeaderSection_MakeHeader header(model);
  header.SetName(text);
  header.SetTimeStamp(new TCollection_HAsciiString(kFixedTime));
  header.Apply(model);
  name_products(*model, text);
}

}  // namespace

TopoDS_Shape read_shape(const std::string& path) {
  return translating_failures(path, [&] {
    const std::lock_guard lock(exchange_mutex());
    const QuietOutput quiet;
    const TopoDS_Shape shape = read_any(path);
    require(!shape.IsNull(), "holds no shape");
    return shape;
  });
}

TopoDS_Shape read_brep_text(const std::string& text) {
  return translating_failures("BREP text", [&] {
    require(format_of(text.substr(0, kHeadLength)) == Format::brep,
            "does not start like the text of a BREP file");
    const std::lock_guard lock(exchange_mutex());
    const QuietOutput quiet;
    std::istringstream stream(text);
    TopoDS_Shape shape;
    BRepTools::Read(shape, stream, BRep_Builder());
    require(!shape.IsNull(), "holds no shape");
    return shape;
  });
}

void write_step(const TopoDS_Shape& shape, const std::string& path, const std::string& name) {
  translating_failures(path, [&] {
    const std::lock_guard lock(exchange_mutex());
    const QuietOutput quiet;
    use_millimetres();
    STEPControl_Writer writer;
    require(writer.Transfer(shape, STEPControl_AsIs) == IFSelect_RetDone,
            "the shape cannot be written as STEP");
    name_and_date(writer.Model(), name);
    require(writer.Write(path.c_str()) == IFSelect_RetDone, "cannot be written");
  });
}

}  // namespace mpm::occt
