// A plugin that has clang-tidy look at this project's code alone. Without it, its hundred checks
// walk through every declaration of every system header too, and drop what they found there: three
// quarters of the time. `--checks=tactus-scope` switches it on; it finds nothing itself.
#include <clang-tidy/ClangTidyCheck.h>
#include <clang-tidy/ClangTidyModule.h>
#include <clang-tidy/ClangTidyModuleRegistry.h>
#include <clang/AST/ASTContext.h>
#include <clang/ASTMatchers/ASTMatchFinder.h>
#include <clang/ASTMatchers/ASTMatchers.h>

#include <vector>

namespace {

namespace matchers = clang::ast_matchers;

class ScopeCheck : public clang::tidy::ClangTidyCheck {
 public:
  using ClangTidyCheck::ClangTidyCheck;

  void registerMatchers(matchers::MatchFinder* finder) override {
    finder->addMatcher(matchers::translationUnitDecl(), this);
  }

  // The unit comes first of all, before the walk asks where to go.
  void check(const matchers::MatchFinder::MatchResult& unit) override {
    const clang::SourceManager& sources = *unit.SourceManager;
    std::vector<clang::Decl*> own;
    for (clang::Decl* declaration : unit.Context->getTranslationUnitDecl()->decls()) {
      const clang::SourceLocation place = sources.getExpansionLoc(declaration->getLocation());
      if (place.isValid() && !sources.isInSystemHeader(place)) {
        own.push_back(declaration);
      }
    }
    unit.Context->setTraversalScope(own);
  }
};

class ScopeModule : public clang::tidy::ClangTidyModule {
 public:
  void addCheckFactories(clang::tidy::ClangTidyCheckFactories& factories) override {
    factories.registerCheck<ScopeCheck>("tactus-scope");
  }
};

const clang::tidy::ClangTidyModuleRegistry::Add<ScopeModule> kAdded("tactus", "what is looked at");

}  // namespace
