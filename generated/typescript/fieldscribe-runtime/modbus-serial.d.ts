/** A line over a client that is connected; it keeps the client's timeout. It has no loop-back test and no padding. */
export class ModbusSerialLine {
    /** @param {ModbusSerialClient} client */
    constructor(client: ModbusSerialClient);
    client: ModbusSerialClient;
    framing: string;
    /** @type {Promise<unknown>} */
    _turn: Promise<unknown>;
    /** @param {Uint8Array} request @param {import("./receiving.js").ReplyShape} reply @returns {Promise<Uint8Array>} */
    exchange(request: Uint8Array, reply: import("./receiving.js").ReplyShape): Promise<Uint8Array>;
    /** @param {Uint8Array} request @param {boolean} isToAll @returns {Promise<Uint8Array>} */
    _exchanged(request: Uint8Array, isToAll: boolean): Promise<Uint8Array>;
}
export type NodeCallback = (error: any, result: any) => void;
/**
 * What a line needs of a client of `modbus-serial`.
 */
export type ModbusSerialClient = {
    isOpen: boolean;
    writeFC1: (unit: number, address: number, count: number, next: NodeCallback) => void;
    writeFC2: (unit: number, address: number, count: number, next: NodeCallback) => void;
    writeFC3: (unit: number, address: number, count: number, next: NodeCallback) => void;
    writeFC4: (unit: number, address: number, count: number, next: NodeCallback) => void;
    writeFC5: (unit: number, address: number, state: boolean, next: NodeCallback) => void;
    writeFC6: (unit: number, address: number, value: number, next: NodeCallback) => void;
    writeFC15: (unit: number, address: number, states: boolean[], next: NodeCallback) => void;
    writeFC16: (unit: number, address: number, values: number[], next: NodeCallback) => void;
};
