// The part of Unity's interface that the package uses, by the scripting reference of 2021.3. It has signatures alone, so that a compiler
// can check the package without Unity.
using System;

namespace UnityEngine
{
    public class Object
    {
        public string name { get; set; }
        public static void DestroyImmediate(Object obj) { }
        public static bool operator ==(Object a, Object b) { return ReferenceEquals(a, b); }
        public static bool operator !=(Object a, Object b) { return !ReferenceEquals(a, b); }
        public override bool Equals(object other) { return ReferenceEquals(this, other); }
        public override int GetHashCode() { return 0; }
    }
    public class Component : Object
    {
        public GameObject gameObject { get { return null; } }
        public Transform transform { get { return null; } }
        public T GetComponent<T>() { return default(T); }
    }
    public struct Vector3 { public Vector3(float x, float y, float z) { } }
    public struct Quaternion { public Quaternion(float x, float y, float z, float w) { } }
    public class Transform : Component
    {
        public Vector3 localPosition { get; set; }
        public Quaternion localRotation { get; set; }
        public Vector3 localScale { get; set; }
    }
    public class GameObject : Object
    {
        public GameObject(string name) { }
        public Transform transform { get { return null; } }
        public T AddComponent<T>() where T : Component { return default(T); }
        public T[] GetComponentsInChildren<T>(bool includeInactive) { return new T[0]; }
    }
    public class Mesh : Object { }
    public class MeshFilter : Component { public Mesh sharedMesh { get; set; } }
    public class Renderer : Component { }
    public class MeshRenderer : Renderer { }
    public class Collider : Component { }
    public class MeshCollider : Collider { public Mesh sharedMesh { get; set; } public bool convex { get; set; } }
    public struct LOD { public LOD(float screenRelativeTransitionHeight, Renderer[] renderers) { } }
    public class LODGroup : Component { public void SetLODs(LOD[] lods) { } public void RecalculateBounds() { } }
    public class TextAsset : Object { public TextAsset(string text) { } }
    public static class Mathf { public static int Min(int a, int b) { return Math.Min(a, b); } }
    public static class Debug { public static void LogError(object message) { } }
    public static class JsonUtility { public static T FromJson<T>(string json) { return default(T); } }
}

namespace UnityEditor
{
    using UnityEngine;
    public class AssetPostprocessor { }
    public static class AssetDatabase
    {
        public static T LoadAssetAtPath<T>(string path) where T : Object { return null; }
        public static void Refresh() { }
        public static void ImportAsset(string path) { }
    }
    public enum PrefabUnpackMode { OutermostRoot, Completely }
    public enum InteractionMode { AutomatedAction, UserAction }
    public static class PrefabUtility
    {
        public static Object InstantiatePrefab(Object asset) { return null; }
        public static Object InstantiatePrefab(Object asset, Transform parent) { return null; }
        public static void UnpackPrefabInstance(GameObject instance, PrefabUnpackMode mode, InteractionMode action) { }
        public static GameObject SaveAsPrefabAsset(GameObject instance, string path) { return null; }
    }
    public static class EditorPrefs
    {
        public static string GetString(string key, string defaultValue) { return defaultValue; }
        public static void SetString(string key, string value) { }
    }
    public static class EditorApplication { public static void Exit(int returnValue) { } }
    [AttributeUsage(AttributeTargets.Method)] public class MenuItem : Attribute { public MenuItem(string itemName) { } }
}

namespace UnityEditor.AssetImporters
{
    using UnityEngine;
    [AttributeUsage(AttributeTargets.Class)] public class ScriptedImporterAttribute : Attribute { public ScriptedImporterAttribute(int version, string ext) { } }
    public abstract class ScriptedImporter { public abstract void OnImportAsset(AssetImportContext ctx); }
    public class AssetImportContext
    {
        public string assetPath { get { return ""; } }
        public void AddObjectToAsset(string identifier, Object obj) { }
        public void SetMainObject(Object obj) { }
        public void LogImportWarning(string msg) { }
    }
}
