"""A plant over FMPy, the same for both versions of FMI."""

from fmpy import read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave


class Plant:
    def __init__(self, fmu, version, initialize=True):
        self.version = version
        self.model = read_model_description(fmu.path)
        self.of = {variable.name: variable.valueReference for variable in self.model.modelVariables}
        kind = FMU2Slave if version == 2 else FMU3Slave
        self.slave = kind(guid=self.model.guid, unzipDirectory=str(fmu.folder), instanceName="plant",
                          modelIdentifier=self.model.coSimulation.modelIdentifier)
        self.slave.instantiate()
        if version == 2:
            self.slave.setupExperiment(startTime=0.0)
        if initialize:
            self.slave.enterInitializationMode()
            self.slave.exitInitializationMode()

    def names(self, causality):
        return [v.name for v in self.model.modelVariables if v.causality == causality]

    def get(self, names):
        references = [self.of[name] for name in names]
        get = self.slave.getReal if self.version == 2 else self.slave.getFloat64
        return list(get(references))

    def set(self, name, value):
        set_ = self.slave.setReal if self.version == 2 else self.slave.setFloat64
        set_([self.of[name]], [value])

    def step(self, point, size):
        return self.slave.doStep(point, size)

    def keep(self):
        return self.slave.getFMUState()

    def go_back(self, state):
        self.slave.setFMUState(state)

    def bytes(self, state):
        return self.slave.serializeFMUState(state)

    def take(self, data):
        return self.slave.deserializeFMUState(data)

    def free(self):
        self.slave.terminate()
        self.slave.freeInstance()
