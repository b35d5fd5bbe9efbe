# Under AddressSanitizer and UndefinedBehaviorSanitizer every room's program runs, five to ten times slower. Left out are
# tests whose code is the same as that of their neighbours and whose point is a count of samples or of runs:
#   many samples   statistics of thousands of renders or draws; the kept tests of the room walk the same code
#   clock          a bar in seconds
#   strace, kills  LeakSanitizer cannot work under a tracer, and the killed runs are the sane program's by the hundred
#   memory         the sanitizer's own shadow and quarantine are counted with the program's
#   install        builds and installs another copy
# A room is never left out as a whole.
set(sanitized_out_film
  PictureError.IntervalHolds* PooledVariances.*)                                             # many samples
set(sanitized_out_fabric
  Quadrature.* Samplers.* DirectionTable.Variance* DirectionTable.LargestWeight* NearModel.HasTheFarModel*  # many samples
  DirectionTable.CompilingAPreset*)                                                          # clock
set(sanitized_out_integrator
  Bounces.AgreeWith* Convergence.* Ground.AgreesWith* Strategies.* Maps.LetAllStrategies*
  NearWeave.Keeps* MappedGaps.Lose* Shutter.GivesTheMean*)                                   # many samples
set(sanitized_out_render
  Bias.* Allocation.Gains* Candidates.PilotPredicts* ClaimedError.* GoldenPictures.OfAllLooks*
  Prediction.HoldsWhatItPromises* Replicates.* VerifyPlan.TheErrorOfPlans* Scale.*)          # many samples
set(sanitized_out_study
  Jackknife.* Cost.ASceneIsMeasured*)                                                        # many samples
set(sanitized_out_app
  Faults.* Kills.* Install.*                                                                 # strace, kills, install
  Memory.*                                                                                   # memory
  Render.ASignalStopsWithin* Render.AnErrorOutOfReachInTheTime*                              # clock
  StudyCommand.Writes* CostCommand.WritesThePriceList*)                                      # many samples

foreach(room ${SATEEN_ROOMS} app)
  if(sanitized_out_${room})
    list(JOIN sanitized_out_${room} ":" left_out)
    set_tests_properties(${room} PROPERTIES ENVIRONMENT "GTEST_FILTER=-${left_out}")
  endif()
endforeach()
