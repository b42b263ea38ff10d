// SPDX-License-Identifier: MIT
#include "tests/bench/glyph_peers/vtk_glyphs.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3D.h>
#include <vtkNew.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTensorGlyph.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <vector>

#include "engine/scene/pair_ellipsoid.hpp"

namespace slamscope::engine {

namespace {

constexpr const char* kRadius = "radius";

/// One cell of all points: bounds are those of cells, and nothing is drawn of what has none.
vtkNew<vtkCellArray> everyPoint(vtkIdType count) {
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(count));
  for (vtkIdType i = 0; i < count; ++i) cells->InsertCellPoint(i);
  return cells;
}

/// A point, a radius and the semi-axes for each pair.
vtkSmartPointer<vtkPolyData> tableOf(const PairGlyphs& glyphs) {
  const auto count = static_cast<vtkIdType>(glyphs.points->pairCount());
  vtkNew<vtkPoints> places;
  vtkNew<vtkFloatArray> radii;
  vtkNew<vtkFloatArray> axes;
  places->SetDataTypeToFloat();
  places->SetNumberOfPoints(count);
  radii->SetName(kRadius);
  radii->SetNumberOfTuples(count);
  axes->SetNumberOfComponents(9);
  axes->SetNumberOfTuples(count);
  vtkIdType at = 0;
  for (std::uint32_t j = 1; j < static_cast<std::uint32_t>(glyphs.points->count()); ++j) {
    for (std::uint32_t i = 0; i < j; ++i, ++at) {
      const Ellipsoid e = pairEllipsoid(glyphs, i, j);
      places->SetPoint(at, e.centre.data());
      radii->SetValue(at, static_cast<float>(std::cbrt(std::abs(e.axes.determinant()))));
      axes->SetTuple(at, e.axes.data());
    }
  }
  auto table = vtkSmartPointer<vtkPolyData>::New();
  table->SetPoints(places);
  table->SetVerts(everyPoint(count));
  table->GetPointData()->SetScalars(radii);
  table->GetPointData()->SetTensors(axes);
  return table;
}

vtkNew<vtkSphereSource> sphere(int resolution) {
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.0);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  return source;
}

vtkSmartPointer<vtkPolyDataMapper> impostors(VtkGlyphs::Way way) {
  if (way == VtkGlyphs::Way::spheres) {
    auto mapper = vtkSmartPointer<vtkOpenGLSphereMapper>::New();
    mapper->SetScaleArray(kRadius);
    return mapper;
  }
  auto mapper = vtkSmartPointer<vtkPointGaussianMapper>::New();
  mapper->SetScaleArray(kRadius);
  mapper->SetScaleFactor(1.0);
  mapper->EmissiveOff();
  mapper->SetTriangleScale(1.5F);
  mapper->SetSplatShaderCode(
      "//VTK::Color::Impl\n"
      "float distance2 = dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy);\n"
      "if (distance2 > 1.0) discard;\n"
      "ambientColor *= 1.0 - distance2;\n"
      "diffuseColor *= 1.0 - distance2;\n");
  return mapper;
}

vtkSmartPointer<vtkPolyDataAlgorithm> meshing(VtkGlyphs::Way way) {
  if (way == VtkGlyphs::Way::tensors) {
    auto filter = vtkSmartPointer<vtkTensorGlyph>::New();
    filter->SetSourceConnection(sphere(16)->GetOutputPort());
    filter->ExtractEigenvaluesOff();
    filter->ColorGlyphsOff();
    return filter;
  }
  auto filter = vtkSmartPointer<vtkGlyph3D>::New();
  filter->SetSourceConnection(sphere(way == VtkGlyphs::Way::meshes ? 8 : 3)->GetOutputPort());
  filter->SetScaleModeToScaleByScalar();
  filter->SetScaleFactor(1.0);
  return filter;
}

void lookFrom(vtkCamera* camera, const View& view) {
  const Eigen::Isometry3d T_scene_eye = view.T_eye_scene.inverse();
  const Eigen::Vector3d eye = T_scene_eye.translation();
  const Eigen::Vector3d ahead = eye + T_scene_eye.linear().col(2);
  const Eigen::Vector3d up = -T_scene_eye.linear().col(1);
  camera->SetPosition(eye.data());
  camera->SetFocalPoint(ahead.data());
  camera->SetViewUp(up.data());
  const double half_height = 0.5 * view.camera.height / view.camera.fy;
  camera->SetViewAngle(2.0 * std::atan(half_height) * 180.0 / M_PI);
  camera->SetClippingRange(0.1, 20.0);
}

}  // namespace

struct VtkGlyphs::Parts {
  std::vector<vtkSmartPointer<vtkPolyData>> tables;
  std::size_t shown = 0;
  vtkSmartPointer<vtkPolyDataAlgorithm> filter;  // none for impostors
  vtkSmartPointer<vtkPolyDataMapper> mapper;
  vtkNew<vtkActor> actor;
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkUnsignedCharArray> pixels;

  void give(vtkPolyData* table) {
    if (filter) {
      filter->SetInputData(table);
    } else {
      mapper->SetInputData(table);
    }
  }
};

VtkGlyphs::VtkGlyphs(Way way, std::span<const View> eyes, std::span<const PairGlyphs> frames)
    : parts_(std::make_unique<Parts>()) {
  for (const PairGlyphs& frame : frames) parts_->tables.push_back(tableOf(frame));
  if (way == Way::spheres || way == Way::gaussians) {
    parts_->mapper = impostors(way);
  } else {
    parts_->filter = meshing(way);
    parts_->mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
    parts_->mapper->SetInputConnection(parts_->filter->GetOutputPort());
  }
  parts_->mapper->ScalarVisibilityOff();
  parts_->give(parts_->tables.front());
  parts_->actor->SetMapper(parts_->mapper);
  const Rgba colour = frames.front().colour;
  parts_->actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);

  parts_->window->SetOffScreenRendering(1);
  parts_->window->SetMultiSamples(0);
  parts_->window->SetSize(static_cast<int>(eyes.size()) * eyes[0].camera.width,
                          eyes[0].camera.height);
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    vtkNew<vtkRenderer> renderer;
    const double width = 1.0 / static_cast<double>(eyes.size());
    const double left = static_cast<double>(i) * width;
    renderer->SetViewport(left, 0.0, left + width, 1.0);
    renderer->AddActor(parts_->actor);
    lookFrom(renderer->GetActiveCamera(), eyes[i]);
    parts_->window->AddRenderer(renderer);
  }
}

VtkGlyphs::~VtkGlyphs() = default;

std::span<const std::uint8_t> VtkGlyphs::draw(std::size_t k) {
  k %= parts_->tables.size();
  if (k != parts_->shown) {
    vtkPolyData* table = parts_->tables[k];
    table->GetPoints()->Modified();
    table->GetPointData()->GetScalars()->Modified();
    table->GetPointData()->GetTensors()->Modified();
    parts_->give(table);
    parts_->shown = k;
  }
  parts_->window->Render();
  const int* size = parts_->window->GetSize();
  parts_->window->GetRGBACharPixelData(0, 0, size[0] - 1, size[1] - 1, 0, parts_->pixels);
  return {parts_->pixels->GetPointer(0),
          static_cast<std::size_t>(parts_->pixels->GetNumberOfValues())};
}

}  // namespace slamscope::engine
