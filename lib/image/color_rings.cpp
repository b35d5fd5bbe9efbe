#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "image/color_config.h"

namespace sateen {

namespace ocio = OCIO_NAMESPACE;

namespace {
// OpenColorIO follows names by calling itself, and what is named twice it follows twice. Configs of productions go
// four deep and come to some dozen.
constexpr size_t deepest = 100;
constexpr double most_names = 1e5;

enum class Kind { space, named_transform, look, view_transform };

struct Part {
  Kind kind;
  std::string name;
  bool operator==(const Part&) const = default;
  auto operator<=>(const Part&) const = default;
};

std::string shown(const Part& part) {
  constexpr const char* kinds[] = {"", "the named transform ", "the look ", "the view transform "};
  return fmt::format("{}{:.80}", kinds[size_t(part.kind)], part.name);
}

/// "+a, -b | c" to a, b, c.
std::vector<std::string> names_of_looks(const std::string& text) {
  std::vector<std::string> names(1);
  for (const char c : text)
    if (c == ',' || c == ':' || c == '|')
      names.emplace_back();
    else if (c != ' ' && c != '\t' && !(names.back().empty() && (c == '+' || c == '-')))
      names.back() += c;
  std::erase(names, "");
  return names;
}

/// Both directions of a part count, whichever a picture takes: OpenColorIO looks through both for variables.
class Walk {
 public:
  explicit Walk(const ocio::Config& config) : config_(config), context_(config.getCurrentContext()) {}

  std::vector<std::string> rings;

  /// What following the part's names comes to.
  double follow(const Part& part) {
    if (const auto known = names_.find(part); known != names_.end()) return known->second;
    if (const auto begin = std::find(path_.begin(), path_.end(), part); begin != path_.end()) {
      std::string ring;
      for (auto one = begin; one != path_.end(); ++one) ring += shown(*one) + " -> ";
      add_ring(ring + shown(part));
      return 1;
    }
    if (path_.size() > deepest) {
      add_ring(fmt::format("{} -> {} -> ... more than {} deep", shown(path_[0]), shown(path_[1]), deepest));
      return 1;
    }
    path_.push_back(part);
    const double names = 1 + below(part);
    path_.pop_back();
    if (names > most_names && !std::exchange(too_many_, true))
      add_ring(fmt::format("{} -> ... to more than {:.0f} names", shown(part), most_names));
    return names_[part] = std::min(names, 2 * most_names);
  }

  double space(const char* name) {
    // Names may hold variables of the context.
    const std::string resolved = context_->resolveStringVar(name);
    if (const auto found = config_.getColorSpace(resolved.c_str())) return follow({Kind::space, found->getName()});
    if (const auto found = config_.getNamedTransform(resolved.c_str()))
      return follow({Kind::named_transform, found->getName()});
    return 0;
  }

  double between(const char* from, const char* to) {
    double names = space(from) + space(to);
    const auto a = config_.getColorSpace(context_->resolveStringVar(from)),
               b = config_.getColorSpace(context_->resolveStringVar(to));
    if (!a || !b || a->getReferenceSpaceType() == b->getReferenceSpaceType()) return names;
    if (const auto transform = config_.getDefaultSceneToDisplayViewTransform())
      names += follow({Kind::view_transform, transform->getName()});
    return names;
  }

  double looks(const char* list) {
    double names = 0;
    for (const std::string& name : names_of_looks(context_->resolveStringVar(list)))
      if (config_.getLook(name.c_str())) names += follow({Kind::look, name});
    return names;
  }

  double view(const char* from, const char* display, const char* view) {
    std::string to = config_.getDisplayViewColorSpaceName(display, view);
    if (to == ocio::OCIO_VIEW_USE_DISPLAY_NAME) to = display;
    double names = between(from, to.c_str()) + looks(config_.getDisplayViewLooks(display, view));
    if (const char* transform = config_.getDisplayViewTransformName(display, view);
        config_.getViewTransform(transform))
      names += follow({Kind::view_transform, transform});
    return names;
  }

 private:
  void add_ring(std::string ring) {
    if (std::find(rings.begin(), rings.end(), ring) == rings.end()) rings.push_back(std::move(ring));
  }

  double below(const Part& part) {
    const char* name = part.name.c_str();
    switch (part.kind) {
      case Kind::space: {
        const auto space = config_.getColorSpace(name);
        return transform(space->getTransform(ocio::COLORSPACE_DIR_TO_REFERENCE)) +
               transform(space->getTransform(ocio::COLORSPACE_DIR_FROM_REFERENCE));
      }
      case Kind::named_transform: {
        const auto named = config_.getNamedTransform(name);
        return transform(named->getTransform(ocio::TRANSFORM_DIR_FORWARD)) +
               transform(named->getTransform(ocio::TRANSFORM_DIR_INVERSE));
      }
      case Kind::look: {
        const auto look = config_.getLook(name);
        return space(look->getProcessSpace()) + transform(look->getTransform()) +
               transform(look->getInverseTransform());
      }
      case Kind::view_transform: {
        const auto view = config_.getViewTransform(name);
        return transform(view->getTransform(ocio::VIEWTRANSFORM_DIR_TO_REFERENCE)) +
               transform(view->getTransform(ocio::VIEWTRANSFORM_DIR_FROM_REFERENCE));
      }
    }
    return 0;
  }

  double transform(const ocio::ConstTransformRcPtr& any) {
    if (const auto group = ocio::DynamicPtrCast<const ocio::GroupTransform>(any)) {
      double names = 0;
      for (int i = 0; i < group->getNumTransforms(); ++i) names += transform(group->getTransform(i));
      return names;
    }
    if (const auto spaces = ocio::DynamicPtrCast<const ocio::ColorSpaceTransform>(any))
      return between(spaces->getSrc(), spaces->getDst());
    if (const auto look = ocio::DynamicPtrCast<const ocio::LookTransform>(any))
      return between(look->getSrc(), look->getDst()) + looks(look->getLooks());
    if (const auto shown = ocio::DynamicPtrCast<const ocio::DisplayViewTransform>(any))
      return view(shown->getSrc(), shown->getDisplay(), shown->getView());
    return 0;
  }

  const ocio::Config& config_;
  ocio::ConstContextRcPtr context_;
  std::vector<Part> path_;
  std::map<Part, double> names_;
  bool too_many_ = false;  ///< said once: whatever leads there has too many as well
};

std::string first_of(const Walk& walk) {
  return walk.rings.empty() ? "" : walk.rings.front();
}
}  // namespace

std::vector<std::string> reference_rings(const ocio::Config& config) {
  Walk walk(config);
  const int spaces = config.getNumColorSpaces(ocio::SEARCH_REFERENCE_SPACE_ALL, ocio::COLORSPACE_ALL);
  for (int i = 0; i < spaces; ++i)
    walk.space(config.getColorSpaceNameByIndex(ocio::SEARCH_REFERENCE_SPACE_ALL, ocio::COLORSPACE_ALL, i));
  for (int i = 0; i < config.getNumNamedTransforms(ocio::NAMEDTRANSFORM_ALL); ++i)
    walk.follow({Kind::named_transform, config.getNamedTransformNameByIndex(ocio::NAMEDTRANSFORM_ALL, i)});
  for (int i = 0; i < config.getNumLooks(); ++i) walk.follow({Kind::look, config.getLookNameByIndex(i)});
  for (int i = 0; i < config.getNumViewTransforms(); ++i)
    walk.follow({Kind::view_transform, config.getViewTransformNameByIndex(i)});
  return walk.rings;
}

std::string ring_between(const ocio::Config& config, const std::string& from, const std::string& to) {
  Walk walk(config);
  walk.between(from.c_str(), to.c_str());
  return first_of(walk);
}

std::string ring_of_view(const ocio::Config& config, const std::string& from, const std::string& display,
                         const std::string& view) {
  Walk walk(config);
  walk.view(from.c_str(), display.c_str(), view.c_str());
  return first_of(walk);
}

}  // namespace sateen
